#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "libtracker/motion/bvh.h"
#include "libtracker/motion/bvh_hierarchy.h"
#include "libtracker/motion/text_scanner.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

// [s] What is slower or faster than this is no frame time in seconds.
constexpr double kMinFrameTime_s = 1e-4;
constexpr double kMaxFrameTime_s = 2.0;

class BvhParser {
 public:
  BvhParser(const std::filesystem::path& path, double fps_if_unsaid) : text_(path, ",", 0) {
    text_.mendDecimalCommas();
    motion_.fps = fps_if_unsaid;
  }

  SourceMotion parse() {
    hierarchy_ = readBvhHierarchy(text_);
    chooseTree();
    const double announced = motionHeader();
    rows(announced);
    restoreOffsets();
    return std::move(motion_);
  }

 private:
  void warn(std::string text) { motion_.warnings.push_back(std::move(text)); }

  void chooseTree() {
    kept_ = largestTree(hierarchy_.bones);
    std::vector<int> index(kept_.size(), -1);
    for (std::size_t b = 0; b < kept_.size(); ++b) {
      if (!kept_[b]) continue;
      index[b] = static_cast<int>(motion_.bones.size());
      MotionBone bone = hierarchy_.bones[b];
      if (bone.parent >= 0) bone.parent = index[static_cast<std::size_t>(bone.parent)];
      motion_.bones.push_back(bone);
    }
    if (motion_.bones.size() < hierarchy_.bones.size()) {
      warn(fmt::format("the file has several roots; only {}, with the most joints, is read", motion_.bones[0].name));
    }
  }

  // The rest of the line that begins with one of the words of the header, joined: "Frames: 20", "Frame Time : 0.03".
  std::string headerValue(const std::string& key, const char* expected) {
    text_.takeLine(words_);
    std::string line;
    for (const std::string_view word : words_) line += lowerCase(word);
    if (line.starts_with(key + ":")) return line.substr(key.size() + 1);
    text_.fail(std::string(expected) + " should stand here");
  }

  // The announced number of frames.
  double motionHeader() {
    const double frames = text_.number(headerValue("frames", "Frames:"), "the number of frames");
    frameTime(text_.number(headerValue("frametime", "Frame Time:"), "the frame time"));
    return frames;
  }

  void frameTime(double time) {
    constexpr double kMillisecond = 1e-3;
    constexpr double kMicrosecond = 1e-6;
    constexpr double kLeastMicroseconds = 1000;
    // Who writes such a number writes frames a second in place of the frame time.
    constexpr std::array<double, 10> kRates = {24, 25, 30, 48, 50, 60, 90, 100, 120, 240};
    if (time >= kMinFrameTime_s && time <= kMaxFrameTime_s) {
      motion_.fps = 1.0 / time;
      return;
    }
    const char* taken = "which no motion has; --fps sets the rate";
    if (std::find(kRates.begin(), kRates.end(), time) != kRates.end()) {
      motion_.fps = time;
      taken = "taken as frames a second";
    } else if (time > kMaxFrameTime_s) {
      const bool micro = time >= kLeastMicroseconds;
      motion_.fps = 1.0 / (time * (micro ? kMicrosecond : kMillisecond));
      taken = micro ? "taken as microseconds" : "taken as milliseconds";
    }
    if (motion_.fps < 1.0 / kMaxFrameTime_s) text_.fail(fmt::format("the frame time is {} s", time));
    warn(fmt::format("the frame time is {}, {}: {:.4g} frames per second", time, taken, motion_.fps));
  }

  // Rows as they come, whatever number is announced: one a line, or, where the first line has another number of values,
  // over several lines. A last row that is cut short is left out.
  void rows(double announced) {
    const std::size_t count = hierarchy_.channel_count;
    if (count == 0) text_.fail("no joint has channels");
    std::vector<double> values;
    bool one_a_line = true;
    bool lines_end_rows = true;
    for (bool first = true; !text_.atEnd(); first = false) {
      text_.takeLine(words_);
      if (first) one_a_line = words_.size() == count;
      if (one_a_line && words_.size() != count) {
        if (words_.size() > count || !text_.atEnd()) {
          text_.fail(fmt::format("the row has {} values, the hierarchy {} channels", words_.size(), count));
        }
        values.resize(1);
        break;
      }
      for (const std::string_view word : words_) {
        values.push_back(text_.number(word, "a value"));
        if (values.size() < count) continue;
        if (word.data() != words_.back().data()) lines_end_rows = false;
        frame(values);
        values.clear();
      }
    }
    checkRows(announced, !values.empty(), lines_end_rows);
  }

  void checkRows(double announced, bool cut, bool lines_end_rows) {
    const auto frames = static_cast<double>(motion_.frames.size());
    if (!lines_end_rows && (cut || frames != announced)) {
      text_.fail(fmt::format("the rows do not fit to the {} channels of the hierarchy", hierarchy_.channel_count),
                 "is a value missing?");
    }
    if (motion_.frames.empty()) text_.fail("there is no whole row of values", "is the file complete?");
    if (cut) warn("the last row is cut short and left out");
    if (frames != announced) {
      warn(fmt::format("the file announces {} frames and has {}: all of these are read", announced, frames));
    }
  }

  void frame(const std::vector<double>& values) {
    MotionFrame frame;
    frame.position.reserve(motion_.bones.size());
    frame.rotation.reserve(motion_.bones.size());
    std::size_t next = 0;
    for (std::size_t b = 0; b < kept_.size(); ++b) {
      Vector3d position = hierarchy_.bones[b].offset;
      Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
      for (const BvhChannel channel : hierarchy_.channels[b]) {
        const double value = values[next++];
        if (channel < kBvhRotation) {
          position[channel] = value;
        } else if (channel < kBvhScale) {
          rotation = rotation * Eigen::Quaterniond(Eigen::AngleAxisd(value * std::numbers::pi / 180.0,
                                                                     Vector3d::Unit(channel - kBvhRotation)));
        }
      }
      if (!kept_[b]) continue;
      frame.position.push_back(position);
      frame.rotation.push_back(rotation);
    }
    motion_.frames.push_back(std::move(frame));
    text_.checkJointFrames(motion_.frames.size() * motion_.bones.size());
  }

  // Position channels of a joint replace its OFFSET, but some programs write what comes on top of it: then they are
  // far nearer to zero than to the OFFSETs.
  void restoreOffsets() {
    constexpr double kNear = 0.1;
    double moved = 0;
    double replaced = 0;
    std::vector<bool> moving(motion_.bones.size(), false);
    for (std::size_t b = 0, kept = 0; b < kept_.size(); ++b) {
      if (!kept_[b]) continue;
      const auto& channels = hierarchy_.channels[b];
      moving[kept] = kept > 0 && std::any_of(channels.begin(), channels.end(), [](int c) { return c < kBvhRotation; });
      if (moving[kept]) {
        for (const MotionFrame& frame : motion_.frames) moved += frame.position[kept].norm();
        replaced += motion_.bones[kept].offset.norm() * static_cast<double>(motion_.frames.size());
      }
      ++kept;
    }
    if (moved >= kNear * replaced) return;
    warn("the joints' position channels are near zero: taken as moves from their OFFSETs");
    for (MotionFrame& frame : motion_.frames) {
      for (std::size_t b = 0; b < moving.size(); ++b) {
        if (moving[b]) frame.position[b] += motion_.bones[b].offset;
      }
    }
  }

  TextScanner text_;
  BvhHierarchy hierarchy_;
  std::vector<bool> kept_;  // one per bone of the hierarchy
  SourceMotion motion_;
  std::vector<std::string_view> words_;
};

}  // namespace

SourceMotion readBvh(const std::filesystem::path& path, double fps_if_unsaid) {
  return BvhParser(path, fps_if_unsaid).parse();
}

}  // namespace depthmocap

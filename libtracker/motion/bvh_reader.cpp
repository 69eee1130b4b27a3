#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "libtracker/motion/bvh.h"
#include "libtracker/motion/text_scanner.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMaxBones = 1000;
constexpr double kMinFrameTime = 1e-4;

class BvhParser {
 public:
  explicit BvhParser(const std::filesystem::path& path) : text_(path, "", 0) {}

  SourceMotion parse() {
    if (lowerCase(text_.take("HIERARCHY")) != "hierarchy")
      text_.fail("the file does not begin with HIERARCHY", "is this a BVH file?");
    hierarchy();
    motion();
    return std::move(motion_);
  }

 private:
  // A channel: 0..2 position x y z, 3..5 rotation x y z.
  struct BoneChannels {
    std::vector<int> channels;
  };

  void hierarchy() {
    if (lowerCase(text_.take("ROOT")) != "root") text_.fail("the hierarchy does not begin with ROOT");
    beginBone(-1);
    int open = 0;  // the bone whose block is being read
    while (open >= 0) {
      const std::string key = lowerCase(text_.take("a line of the hierarchy"));
      if (key == "offset") {
        motion_.bones[static_cast<std::size_t>(open)].offset = vector("an offset");
      } else if (key == "channels") {
        channels(open);
      } else if (key == "joint") {
        beginBone(open);
        open = static_cast<int>(motion_.bones.size()) - 1;
      } else if (key == "end") {
        endSite(open);
      } else if (key == "}") {
        open = motion_.bones[static_cast<std::size_t>(open)].parent;
      } else if (key == "{" || key == "motion") {
        text_.fail(fmt::format("'{}' does not belong here", key), "are the braces of the hierarchy complete?");
      } else {
        text_.takeRestOfLine(words_);
      }
    }
  }

  // The name is the rest of the line, blanks as underscores, as other programs read it.
  void beginBone(int parent) {
    if (motion_.bones.size() >= kMaxBones) text_.fail("too many joints");
    MotionBone bone;
    bone.parent = parent;
    text_.takeRestOfLine(words_);
    bool open = false;
    for (const std::string_view word : words_) {
      open = word == "{";
      if (open) break;
      if (!bone.name.empty()) bone.name += '_';
      bone.name += word;
    }
    if (bone.name.empty()) text_.fail("a joint without a name");
    if (!open && text_.take("'{'") != "{") text_.fail("'{' should stand here");
    motion_.bones.push_back(bone);
    channels_.emplace_back();
  }

  void endSite(int bone) {
    if (lowerCase(text_.take("Site")) != "site") text_.fail("'End' without 'Site'");
    if (text_.take("'{'") != "{") text_.fail("'{' should stand here");
    auto& parent = motion_.bones[static_cast<std::size_t>(bone)];
    for (;;) {
      const std::string key = lowerCase(text_.take("the End Site's offset"));
      if (key == "}") break;
      if (key == "offset") {
        parent.tip = vector("an offset");
        parent.has_tip = true;
      } else {
        text_.takeRestOfLine(words_);
      }
    }
  }

  Vector3d vector(const char* what) {
    Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = text_.takeNumber(what);
    return v;
  }

  void channels(int bone) {
    static const std::map<std::string, int> kNames = {{"xposition", 0}, {"yposition", 1}, {"zposition", 2},
                                                      {"xrotation", 3}, {"yrotation", 4}, {"zrotation", 5}};
    auto& list = channels_[static_cast<std::size_t>(bone)].channels;
    if (!list.empty()) text_.fail("a joint has CHANNELS twice");
    const double count = text_.takeNumber("the number of channels");
    if (count < 0 || count > 6 || count != std::floor(count)) text_.fail("the number of channels must be 0 to 6");
    for (int i = 0; i < static_cast<int>(count); ++i) {
      const auto found = kNames.find(lowerCase(text_.take("a channel")));
      if (found == kNames.end())
        text_.fail("an unknown channel", "known: Xposition .. Zposition, Xrotation .. Zrotation");
      for (const int other : list) {
        if (other == found->second) text_.fail("a channel is given twice");
      }
      list.push_back(found->second);
    }
    channel_count_ += list.size();
  }

  void keyword(const char* first, const char* expected) {
    if (lowerCase(text_.take(expected)) != first) text_.fail(std::string(expected) + " should stand here");
  }

  void motion() {
    keyword("motion", "MOTION");
    keyword("frames:", "Frames:");
    const double frames = text_.takeNumber("the number of frames");
    if (frames < 1 || frames != std::floor(frames)) text_.fail("the number of frames must be at least 1");
    keyword("frame", "Frame Time:");
    keyword("time:", "Frame Time:");
    const double frame_time = text_.takeNumber("the frame time");
    if (frame_time < kMinFrameTime) text_.fail("the frame time must be at least 0.0001 s");
    motion_.fps = 1.0 / frame_time;
    // Nothing is reserved from the announced number: memory grows only with rows that are there.
    for (double i = 0; i < frames; ++i) {
      if (text_.atEnd()) text_.fail("the file ends before the announced number of frames", "is the file complete?");
      row();
    }
    if (!text_.atEnd()) text_.fail("there are more rows than the announced number of frames");
  }

  void row() {
    text_.takeLine(words_);
    if (words_.size() != channel_count_) {
      text_.fail(fmt::format("the row has {} values, the hierarchy {} channels", words_.size(), channel_count_));
    }
    MotionFrame frame;
    std::size_t next = 0;
    for (std::size_t b = 0; b < motion_.bones.size(); ++b) {
      Vector3d position = motion_.bones[b].offset;
      Eigen::Quaterniond rotation = Eigen::Quaterniond::Identity();
      for (const int channel : channels_[b].channels) {
        const double value = text_.number(words_[next++], "a value");
        if (channel < 3) {
          position[channel] = value;
        } else {
          rotation = rotation * Eigen::Quaterniond(
                                    Eigen::AngleAxisd(value * std::numbers::pi / 180.0, Vector3d::Unit(channel - 3)));
        }
      }
      frame.position.push_back(position);
      frame.rotation.push_back(rotation);
    }
    motion_.frames.push_back(std::move(frame));
    text_.checkJointFrames(motion_.frames.size() * motion_.bones.size());
  }

  TextScanner text_;
  SourceMotion motion_;
  std::vector<BoneChannels> channels_;
  std::size_t channel_count_ = 0;
  std::vector<std::string_view> words_;
};

}  // namespace

SourceMotion readBvh(const std::filesystem::path& path) {
  return BvhParser(path).parse();
}

}  // namespace depthmocap

#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "libtracker/core/check.h"
#include "libtracker/motion/asf_amc.h"
#include "libtracker/motion/text_scanner.h"

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

bool isFrameNumber(const std::vector<std::string_view>& words) {
  return words.size() == 1 && words[0].find_first_not_of("0123456789") == std::string_view::npos;
}

class AmcParser {
 public:
  AmcParser(const std::filesystem::path& path, const AsfSkeleton& skeleton)
      : text_(path, "", '#'), skeleton_(skeleton), degrees_(skeleton.degrees) {
    for (std::size_t b = 0; b < skeleton.bones.size(); ++b) {
      index_.emplace(skeleton.bones[b].name, b);
      rest_.position.push_back(skeleton.bones[b].offset);
      rest_.rotation.push_back(Eigen::Quaterniond::Identity());
      if (!skeleton.motions[b].channels.empty()) ++moving_;
    }
    rigid_.assign(skeleton.bones.size(), false);
  }

  SourceMotion parse(double fps) {
    while (!text_.atEnd()) {
      text_.takeLine(words_);
      if (words_[0].starts_with(':')) {
        keyword();
      } else if (isFrameNumber(words_)) {
        beginFrame();
      } else {
        bone();
      }
    }
    if (!frameIsWhole() && frames_.size() > 1) {
      frames_.pop_back();
      warnings_.emplace_back("the last frame is cut short and left out");
    } else {
      endFrame();
    }
    if (frames_.empty()) text_.fail("there is no frame", "is this an AMC file?");
    return {skeleton_.bones, fps, std::move(frames_), std::move(warnings_)};
  }

 private:
  void keyword() {
    const std::string key = lowerCase(words_[0]);
    if (key == ":degrees") degrees_ = true;
    if (key == ":radians") degrees_ = false;
  }

  void beginFrame() {
    endFrame();
    const double number = text_.number(words_[0], "a frame number");
    if (number <= last_number_) text_.fail("frame numbers must grow");
    last_number_ = number;
    frames_.push_back(rest_);
    text_.checkJointFrames(frames_.size() * skeleton_.bones.size());
    given_.assign(skeleton_.bones.size(), false);
    given_count_ = 0;
  }

  [[nodiscard]] bool frameIsWhole() const { return frames_.empty() || given_count_ == moving_; }

  // Bones that the first frame does not have, no frame may have: they do not move.
  void endFrame() {
    if (frameIsWhole()) return;
    for (std::size_t b = 0; b < given_.size(); ++b) {
      if (given_[b] || !moves(b)) continue;
      if (frames_.size() > 1 || given_count_ == 0) {
        text_.fail(fmt::format("the frame ends without the bone {}", skeleton_.bones[b].name), "is the file complete?");
      }
      rigid_[b] = true;
      --moving_;
      warnings_.push_back(
          fmt::format("the frames do not have the bone {}: it is taken as rigid", skeleton_.bones[b].name));
    }
  }

  [[nodiscard]] bool moves(std::size_t bone) const {
    return !skeleton_.motions[bone].channels.empty() && !rigid_[bone];
  }

  void bone() {
    const std::string name(words_[0]);
    if (frames_.empty()) text_.fail("a line before the first frame number", "is this an AMC file?");
    const auto found = index_.find(name);
    if (found == index_.end()) {
      text_.fail(fmt::format("the skeleton has no bone '{}'", name), "is this the ASF that belongs to the motion?");
    }
    const std::size_t b = found->second;
    const AsfSkeleton::Motion& motion = skeleton_.motions[b];
    if (words_.size() != motion.channels.size() + 1) {
      text_.fail(
          fmt::format("the bone {} needs {} values, here are {}", name, motion.channels.size(), words_.size() - 1));
    }
    if (rigid_[b]) text_.fail(fmt::format("the frames before do not have the bone {}", name), "is the file complete?");
    if (given_[b]) text_.fail(fmt::format("the bone {} is given twice in one frame", name));
    given_[b] = true;
    ++given_count_;
    turn(b, motion);
  }

  // A sequence about fixed axes: the first channel turns first.
  void turn(std::size_t b, const AsfSkeleton::Motion& motion) {
    const double unit = degrees_ ? std::numbers::pi / 180.0 : 1.0;
    Matrix3d R = Matrix3d::Identity();
    Vector3d translation = Vector3d::Zero();
    for (std::size_t i = 0; i < motion.channels.size(); ++i) {
      const double value = text_.number(words_[i + 1], "a value");
      const int channel = static_cast<int>(motion.channels[i]);
      if (motion.channels[i] == MotionChannel::Length) continue;
      if (channel < 3) {
        translation[channel] = value * skeleton_.metres_per_unit;
      } else {
        R = Eigen::AngleAxisd(unit * value, Vector3d::Unit(channel - 3)).toRotationMatrix() * R;
      }
    }
    MotionFrame& frame = frames_.back();
    frame.rotation[b] = Eigen::Quaterniond(motion.axis * R * motion.axis.transpose() * motion.orientation).normalized();
    frame.position[b] += motion.position + translation;
  }

  TextScanner text_;
  const AsfSkeleton& skeleton_;
  bool degrees_;
  std::vector<std::string_view> words_;
  std::map<std::string, std::size_t> index_;
  MotionFrame rest_;
  std::size_t moving_ = 0;
  std::vector<bool> rigid_;  // bones with channels that the frames do not have
  std::vector<std::string> warnings_;
  std::vector<MotionFrame> frames_;
  double last_number_ = -1;
  std::vector<bool> given_;
  std::size_t given_count_ = 0;
};

}  // namespace

SourceMotion readAmc(const std::filesystem::path& path, const AsfSkeleton& skeleton, double fps) {
  DMC_CHECK(fps > 0);
  return AmcParser(path, skeleton).parse(fps);
}

}  // namespace depthmocap

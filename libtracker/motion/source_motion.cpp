#include "libtracker/motion/source_motion.h"

#include <algorithm>
#include <cmath>

#include "libtracker/core/check.h"

namespace depthmocap {

int SourceMotion::find(std::string_view name) const {
  const auto found = std::find_if(bones.begin(), bones.end(), [&](const MotionBone& b) { return b.name == name; });
  return found == bones.end() ? -1 : static_cast<int>(found - bones.begin());
}

void globalFrame(const std::vector<MotionBone>& bones, const MotionFrame& frame, GlobalFrame& global) {
  global.position.resize(bones.size());
  global.rotation.resize(bones.size());
  for (std::size_t b = 0; b < bones.size(); ++b) {
    const Eigen::Matrix3d R = frame.rotation[b].toRotationMatrix();
    if (bones[b].parent < 0) {
      global.rotation[b] = R;
      global.position[b] = frame.position[b];
    } else {
      const auto p = static_cast<std::size_t>(bones[b].parent);
      global.rotation[b].noalias() = global.rotation[p] * R;
      global.position[b] = global.rotation[p] * frame.position[b] + global.position[p];
    }
  }
}

GlobalFrame restFrame(const std::vector<MotionBone>& bones) {
  MotionFrame rest;
  for (const MotionBone& bone : bones) {
    rest.position.push_back(bone.offset);
    rest.rotation.push_back(Eigen::Quaterniond::Identity());
  }
  GlobalFrame global;
  globalFrame(bones, rest, global);
  return global;
}

std::vector<MotionBone> meanBones(const SourceMotion& motion) {
  std::vector<MotionBone> bones = motion.bones;
  if (motion.frames.empty()) return bones;
  for (std::size_t b = 1; b < bones.size(); ++b) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const MotionFrame& frame : motion.frames) sum += frame.position[b];
    bones[b].offset = sum / static_cast<double>(motion.frames.size());
  }
  return bones;
}

SourceMotion resampled(const SourceMotion& motion, double fps) {
  DMC_CHECK(fps > 0 && motion.fps > 0);
  SourceMotion result{motion.bones, fps, {}, motion.warnings};
  if (motion.frames.empty()) return result;
  const double step = motion.fps / fps;
  const double last = static_cast<double>(motion.frames.size() - 1);
  for (std::size_t k = 0;; ++k) {
    // The small allowance keeps the last frame in spite of a rate that was written with few digits.
    const double t = static_cast<double>(k) * step;
    if (t > last + 1e-3) break;
    const auto a = static_cast<std::size_t>(std::min(std::floor(t), last));
    const std::size_t b = std::min(a + 1, motion.frames.size() - 1);
    const double share = std::clamp(t - static_cast<double>(a), 0.0, 1.0);
    MotionFrame frame = motion.frames[a];
    for (std::size_t i = 0; i < frame.rotation.size(); ++i) {
      frame.rotation[i] = frame.rotation[i].slerp(share, motion.frames[b].rotation[i]);
      frame.position[i] += share * (motion.frames[b].position[i] - motion.frames[a].position[i]);
    }
    result.frames.push_back(std::move(frame));
  }
  return result;
}

}  // namespace depthmocap

#include "libtracker/output/edit_motion.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

// Between two poses, t in [0, 1].
Pose between(const Pose& a, const Pose& b, double t) {
  Pose q = a;
  q.head<3>() = (1.0 - t) * a.head<3>() + t * b.head<3>();
  for (int i = 0; i < kBoneCount; ++i) {
    const auto bone = static_cast<Bone>(i);
    const Eigen::Quaterniond from(localRotation(bone, a));
    setLocalRotation(bone, from.slerp(t, Eigen::Quaterniond(localRotation(bone, b))).toRotationMatrix(), q);
  }
  return q;
}

// 0 to 1 without a jump of the speed.
double smoothStep(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// `q` turned by the share `w` of what turns `last` into `first`, bone by bone.
void takeAway(const Pose& first, const Pose& last, double w, Pose& q) {
  for (int i = 0; i < kBoneCount; ++i) {
    const auto bone = static_cast<Bone>(i);
    const Eigen::Quaterniond difference(localRotation(bone, last).transpose() * localRotation(bone, first));
    const Eigen::Quaterniond part = Eigen::Quaterniond::Identity().slerp(w, difference);
    setLocalRotation(bone, localRotation(bone, q) * part.toRotationMatrix(), q);
  }
  q.head<3>() += w * (first - last).head<3>();
}

}  // namespace

MotionTrack resampled(const MotionTrack& track, double fps) {
  MotionTrack result{track.lengths, {}};
  if (track.frames.size() < 2) return track;
  const double start_s = track.frames.front().time_s;
  // A billionth of a frame more, so that rounding does not lose the last one.
  const double length = (track.frames.back().time_s - start_s) * fps + 1e-9;
  std::size_t next = 1;
  for (std::size_t i = 0; static_cast<double>(i) <= length; ++i) {
    const double time_s = start_s + static_cast<double>(i) / fps;
    while (next + 1 < track.frames.size() && track.frames[next].time_s < time_s) ++next;
    const MotionTrack::Frame& a = track.frames[next - 1];
    const MotionTrack::Frame& b = track.frames[next];
    const double t = std::clamp((time_s - a.time_s) / (b.time_s - a.time_s), 0.0, 1.0);
    result.frames.push_back({time_s, between(a.q, b.q, t), (1.0 - t) * a.scale + t * b.scale});
  }
  return result;
}

void keepInPlace(MotionTrack& track) {
  for (MotionTrack::Frame& frame : track.frames) frame.q[kRootTx] = frame.q[kRootTz] = 0;
}

void closeLoop(MotionTrack& track, bool and_place) {
  if (track.frames.size() < 2) return;
  const Pose last = track.frames.back().q;
  Pose first = track.frames.front().q;
  if (!and_place) {
    for (const int dof : {kRootTx, kRootTz, kRootRy}) first[dof] = last[dof];
  }
  const double end_s = track.frames.back().time_s;
  const double blend_s = std::min(kLoopBlend_s, 0.5 * (end_s - track.frames.front().time_s));
  for (MotionTrack::Frame& frame : track.frames) {
    const double w = smoothStep(1.0 - (end_s - frame.time_s) / blend_s);
    if (w > 0) takeAway(first, last, w, frame.q);
  }
}

}  // namespace depthmocap

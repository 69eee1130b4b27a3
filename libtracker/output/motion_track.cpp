#include "libtracker/output/motion_track.h"

#include <algorithm>
#include <cmath>

#include "libtracker/core/check.h"

namespace depthmocap {

bool MotionTrack::sizeChanges() const {
  constexpr double kSame = 1e-6;
  return std::any_of(frames.begin(), frames.end(), [](const Frame& f) { return std::abs(f.scale - 1.0) > kSame; });
}

double MotionTrack::frameTime_s(double fallback_fps) const {
  if (frames.size() < 2) return 1.0 / fallback_fps;
  return (frames.back().time_s - frames.front().time_s) / static_cast<double>(frames.size() - 1);
}

void MotionTrackBuilder::add(double time_s, const Pose& q, const BoneLengths& lengths) {
  const double stature_m = statureOf(lengths);
  if (!seen_) {
    for (MotionTrack::Frame& before : frames_) {
      before.q = q;
      before.scale = stature_m;
    }
  }
  seen_ = true;
  frames_.push_back({time_s, q, stature_m});
}

void MotionTrackBuilder::addLost(double time_s) {
  MotionTrack::Frame frame;
  if (!frames_.empty()) frame = frames_.back();
  frame.time_s = time_s;
  frames_.push_back(frame);
}

MotionTrack MotionTrackBuilder::track(const BoneLengths& lengths) const {
  DMC_CHECK(!empty());
  MotionTrack track{lengths, frames_};
  const double final_stature_m = statureOf(lengths);
  for (MotionTrack::Frame& frame : track.frames) frame.scale /= final_stature_m;
  return track;
}

}  // namespace depthmocap

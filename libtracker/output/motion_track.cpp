#include "libtracker/output/motion_track.h"

#include <algorithm>
#include <cmath>

#include "libtracker/core/check.h"
#include "libtracker/output/floor_origin.h"

namespace depthmocap {

bool MotionTrack::sizeChanges() const {
  constexpr double kSame = 1e-6;
  return std::any_of(frames.begin(), frames.end(), [](const Frame& f) { return std::abs(f.scale - 1.0) > kSame; });
}

double MotionTrack::frameTime_s(double fallback_fps) const {
  if (frames.size() < 2) return 1.0 / fallback_fps;
  return (frames.back().time_s - frames.front().time_s) / static_cast<double>(frames.size() - 1);
}

Eigen::Vector3d moveToFloor(std::vector<MotionTrack>& tracks) {
  if (tracks.empty() || tracks.front().frames.empty()) return Eigen::Vector3d::Zero();
  std::vector<double> soles_y;
  for (const MotionTrack& track : tracks) {
    for (const MotionTrack::Frame& frame : track.frames) {
      soles_y.push_back(lowerSole(makeSkeleton(track.lengths.scaled(frame.scale)), frame.q));
    }
  }
  const auto median = soles_y.begin() + static_cast<std::ptrdiff_t>(soles_y.size() / 2);
  std::nth_element(soles_y.begin(), median, soles_y.end());
  const Pose& first = tracks.front().frames.front().q;
  Eigen::Vector3d origin(first[kRootTx], *median, first[kRootTz]);
  for (MotionTrack& track : tracks) {
    for (MotionTrack::Frame& frame : track.frames) frame.q.head<3>() -= origin;
  }
  return origin;
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

#pragma once
#include <vector>

#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The motion of one run, for animation files: they need the body's final size and all frames at once.
struct MotionTrack {
  struct Frame {
    double time_s = 0;  // [s] strictly increasing
    Pose q = Pose::Zero();
    double scale = 1;  // the body's size in this frame as a share of its final size
  };
  BoneLengths lengths;  // [m] at the end of the run
  std::vector<Frame> frames;

  // Whether the size was still being found somewhere.
  [[nodiscard]] bool sizeChanges() const;
  // The mean time between frames [s]; 1 / fallback_fps for a single frame.
  [[nodiscard]] double frameTime_s(double fallback_fps) const;
};

// Moves the motion of everybody in a file by one translation: the lower sole is on y = 0 in the median frame, and the
// first track's hips begin above x = z = 0. Returns where the new origin was [m]; without tracks nothing happens.
Eigen::Vector3d moveToFloor(std::vector<MotionTrack>& tracks);

// Collects a track frame by frame. An animation has no gaps: the pose rests while the actor is lost, and before the
// actor was first seen it is the first pose.
class MotionTrackBuilder {
 public:
  void add(double time_s, const Pose& q, const BoneLengths& lengths);
  void addLost(double time_s);
  [[nodiscard]] bool empty() const { return !seen_; }
  // `lengths`: the body's at the end of the run; frames were added, one of them with a pose.
  [[nodiscard]] MotionTrack track(const BoneLengths& lengths) const;

 private:
  bool seen_ = false;
  std::vector<MotionTrack::Frame> frames_;  // scale: the stature [m], as long as the final one is not known
};

}  // namespace depthmocap

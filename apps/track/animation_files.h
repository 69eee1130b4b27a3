#pragma once
#include <filesystem>

#include "apps/track/track_options.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/output/motion_track.h"

namespace depthmocap {

// The motion as BVH and glTF, as the options ask. Written at the end: a body's bone lengths are known only then.
class AnimationFiles {
 public:
  // `fps` [1/s] (> 0) of the recording.
  AnimationFiles(const TrackOptions& options, double fps);
  void add(const TrackedFrame& tracked);
  // Once; `lengths`: the body's at the end. Error where nobody was tracked or a file cannot be written.
  void write(const BoneLengths& lengths);

 private:
  void writeBvh(const MotionTrack& track) const;

  std::filesystem::path bvh_;
  std::filesystem::path gltf_;
  bool bvh_rigid_;
  double bvh_scale_;
  double fps_;
  MotionTrackBuilder motion_;
};

}  // namespace depthmocap

#pragma once
#include <filesystem>
#include <span>
#include <vector>

#include "apps/track/track_options.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/output/motion_track.h"

namespace depthmocap {

// The motion as BVH and glTF, as the options ask. Written at the end: a body's bone lengths are known only then. Of
// several people each has a BVH file of its own (M-1.bvh, M-2.bvh, ...), and all are in one glTF file;
// their places in one room are kept.
class AnimationFiles {
 public:
  // `fps` [1/s] (> 0) of the recording.
  AnimationFiles(const TrackOptions& options, double fps);
  // Everybody in the next frame; the same number of people at every call.
  void add(std::span<const TrackedFrame* const> people);
  // Once. Error where nobody was tracked or a file cannot be written.
  void write();

 private:
  struct Person {
    int number = 1;
    BoneLengths lengths;  // at the end
    MotionTrackBuilder motion;
  };
  [[nodiscard]] std::filesystem::path bvhOf(int number) const;
  void writeBvh(const std::filesystem::path& path, const MotionTrack& track) const;

  std::filesystem::path bvh_;
  std::filesystem::path gltf_;
  bool floor_origin_;
  bool bvh_moving_;
  double bvh_scale_;
  double fps_;
  std::vector<Person> people_;
};

}  // namespace depthmocap

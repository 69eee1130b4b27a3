#pragma once
#include <span>

#include "apps/track/collected_motion.h"
#include "apps/track/track_options.h"

namespace depthmocap {

// The files that are written at the end of a run, because they need the whole motion: for animation and laboratories.
class MotionFiles {
 public:
  // `fps` [1/s] (> 0) of the recording. The options outlive it.
  MotionFiles(const TrackOptions& options, double fps);
  // Everybody in the next frame; the same number of people at every call.
  void add(std::span<const TrackedFrame* const> people);
  // Once; a second call does nothing. Error where nobody was tracked or a file cannot be written.
  void write();

 private:
  const TrackOptions& options_;
  double fps_;
  bool pending_;  // files are asked for and not written
  bool laboratory_;
  CollectedMotion motion_;
};

}  // namespace depthmocap

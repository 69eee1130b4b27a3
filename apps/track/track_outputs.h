#pragma once
#include <memory>

#include "apps/track/track_options.h"
#include "depthmocap/actor.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {

// Every file that a tracking run writes, as the options ask. Rows are written while tracking; finish() completes all
// files, and the destructor does so too where a failure came first, so that what was tracked is kept.
class TrackOutputs {
 public:
  TrackOutputs(const TrackOptions& options, const RecordingInfo& info);
  ~TrackOutputs();
  // Returns what was written: the tracked frame, smoothed as the options ask. Valid until the next call.
  const TrackedFrame& write(const DepthFrame& frame, const TrackedFrame& tracked);
  // `actor`: the body at the end of the run.
  void finish(const Actor& actor);

 private:
  struct Files;
  std::unique_ptr<Files> files_;
};

}  // namespace depthmocap

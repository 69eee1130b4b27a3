#pragma once
#include <memory>
#include <span>

#include "apps/track/track_options.h"
#include "libtracker/recording/recording.h"
#include "libtracker/session/frame_sink.h"

namespace depthmocap {

// Every file that a tracking run writes, as the options ask. Rows are written while tracking; finish() completes all
// files, and the destructor does so too where a failure came first, so that what was tracked is kept.
class TrackOutputs : public FrameSink {
 public:
  // The options outlive it.
  TrackOutputs(const TrackOptions& options, const RecordingInfo& info);
  ~TrackOutputs() override;
  TrackOutputs(const TrackOutputs&) = delete;
  TrackOutputs& operator=(const TrackOutputs&) = delete;
  void onFrame(const SessionFrame& frame) override;
  void finish();

 private:
  struct Files;
  static void writeAngles(Files& files, std::span<const TrackedFrame* const> people);

  std::unique_ptr<Files> files_;
};

}  // namespace depthmocap

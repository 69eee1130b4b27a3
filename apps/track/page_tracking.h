#pragma once
#include <optional>

#include "apps/track/recording_run.h"
#include "apps/view/recording_tracker.h"

namespace depthmocap {

// Tracks the recordings that somebody opens on the page, as `replay` does with the options that its command was given:
// body, parameters, threads. What belongs to the command's own recording alone (--first, --last, --camera, --turn)
// holds for no other; what the command writes itself is not written again.
class PageTracking : public RecordingTracker {
 public:
  // `options`: `recording` is empty where the command has none. `models`: those of the options, where they are loaded.
  explicit PageTracking(ReplayOptions options, std::optional<Models> models = {});

  [[nodiscard]] const std::vector<ExportFormat>& formats() const override;
  void track(const TrackTask& task, FrameSink& watcher, const ReplayHooks& hooks) override;

 private:
  [[nodiscard]] ReplayOptions optionsFor(const TrackTask& task) const;

  const ReplayOptions options_;
  std::optional<Models> models_;  // else loaded when first needed
};

// The options of a command without the outputs that it writes.
TrackOptions withoutOutputs(TrackOptions options);

}  // namespace depthmocap

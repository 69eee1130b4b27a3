#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "apps/track/track_options.h"
#include "calibration/calibrator.h"
#include "depthmocap/tracker.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {

// A T-pose calibration while the camera runs: time to take the pose, frames with advice, the fitted body.
class LiveCalibration {
 public:
  // Error where a model is missing.
  LiveCalibration(const TrackOptions& options, const RecordingInfo& info);
  // The next frame; whether text() has changed. Error where the actor has not taken the pose in time.
  bool add(const DepthFrame& frame);
  [[nodiscard]] bool enough() const { return calibrator_.enough(); }
  // Fits the body, writes it to `path` and gives it to the tracker. Error says what to change.
  void finish(const std::filesystem::path& path, Tracker& tracker);
  // What to tell the actor now.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool say(const std::string& text);

  const TrackOptions& options_;
  const RecordingInfo& info_;
  Calibrator calibrator_;
  std::optional<double> start_s_;  // of the sensor's time
  std::string text_;
};

}  // namespace depthmocap

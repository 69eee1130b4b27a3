#pragma once
#include <future>
#include <memory>
#include <optional>
#include <string>

#include "calibration/calibration_run.h"
#include "calibration/other_frames.h"

namespace depthmocap {

// A calibration while the camera runs and the tracker goes on: time to take the pose, frames with advice, then the
// solve on a thread of its own, so that no frame waits for it.
class LiveCalibration {
 public:
  // Loads what it needs in the background. `tracking`: the tracker's models.
  LiveCalibration(const Models& tracking, const CameraModel& camera, const CalibrationRunConfig& config);
  ~LiveCalibration();  // waits for a solve that has begun
  LiveCalibration(const LiveCalibration&) = delete;
  LiveCalibration& operator=(const LiveCalibration&) = delete;

  // The next frame; whether text() has changed. Throws Error where the actor has not taken the pose in time, or a model
  // is missing.
  bool add(const DepthFrame& frame);
  // The actor, once the solve has ended. Throws Error saying what to change where it failed.
  std::optional<Actor> finished();
  // What to tell the actor now.
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  bool say(const std::string& text);
  void startSolving();

  std::future<std::unique_ptr<CalibrationRun>> loading_;
  std::unique_ptr<CalibrationRun> run_;
  OtherFrames others_;
  std::future<Actor> solving_;
  std::optional<double> start_s_;  // by the sensor's time
  std::string text_;
};

}  // namespace depthmocap

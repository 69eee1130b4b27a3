#pragma once
#include <functional>
#include <memory>

#include "calibration/calibrator.h"
#include "depthmocap/models.h"
#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {

struct CalibrationRunConfig {
  CalibratorConfig calibrator;
  bool tpose_only = false;  // nothing but the T-pose, as the paper does
  std::string camera_name;  // of the calibrating camera, for the actor file
};

// One calibration from the first frame to the actor, for the command and for the page: T-pose frames are collected, the
// body is fitted to them; frames in other poses are then tracked with that body, and both are solved for together.
class CalibrationRun {
 public:
  // Calls its argument with each of some frames, in order.
  using Frames = std::function<void(const std::function<void(const DepthFrame&)>&)>;

  // Frames that are looked at for other poses; more are passed over.
  static constexpr std::size_t kMostOthers = 300;

  CalibrationRun(const Models& tracking, std::shared_ptr<const CalibratorModels> models, const CameraModel& camera,
                 const CalibrationRunConfig& config);

  // Judges the next frame and keeps it if it is a good one; what to tell the actor.
  TPoseVerdict add(const DepthFrame& frame) { return calibrator_.add(frame); }
  [[nodiscard]] int goodFrames() const { return calibrator_.goodFrames(); }
  [[nodiscard]] bool enough() const { return calibrator_.enough(); }

  // The actor, by the good frames and by `others`, frames of the same actor in any poses (may hold none). Throws Error
  // saying what to change, as Calibrator does.
  Actor solve(const Frames& others);

  // Wall time of the solve by the T-pose [s].
  [[nodiscard]] double solve_s() const { return solve_s_; }
  [[nodiscard]] const Calibrator::Shown& shown() const { return calibrator_.shown(); }

 private:
  struct OtherPoses;
  OtherPoses track(const Frames& frames, const std::optional<Actor>& actor, double stature_m) const;
  Actor solveByTPose(const Frames& others);
  Actor solveByAnyPose(const Frames& frames);

  const Models tracking_;
  const CameraModel camera_;
  const CalibrationRunConfig config_;
  Calibrator calibrator_;
  double solve_s_ = 0;
};

}  // namespace depthmocap

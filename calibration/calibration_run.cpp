#include "calibration/calibration_run.h"

#include <chrono>
#include <utility>

#include "calibration/pose_collector.h"
#include "depthmocap/tracker.h"

namespace depthmocap {
namespace {

constexpr int kOtherFrames = 12;          // frames in other poses that are solved for
constexpr std::size_t kFewestOthers = 4;  // fewer say less than they disturb

template <typename Work>
double secondsOf(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

// What the tracker makes of frames in any poses.
struct CalibrationRun::OtherPoses {
  std::vector<PoseObservation> observations;
  double stature_m = 0;  // of the body that they were tracked with in the end
};

CalibrationRun::CalibrationRun(const Models& tracking, std::shared_ptr<const CalibratorModels> models,
                               const CameraModel& camera, const CalibrationRunConfig& config)
    : tracking_(tracking),
      camera_(camera),
      config_(config),
      calibrator_(std::move(models), camera, config.calibrator) {}

// With the body that the T-pose gave, or without one with an average body of this stature; 0: the tracker's default.
CalibrationRun::OtherPoses CalibrationRun::track(const Frames& frames, const std::optional<Actor>& actor,
                                                 double stature_m) const {
  TrackerConfig config;
  config.threads = config_.calibrator.threads;
  if (stature_m > 0) config.policy.assumed_stature_m = stature_m;
  Tracker tracker(tracking_, camera_, config, actor);
  PoseCollector collector(camera_, config_.calibrator.points_per_part);
  std::size_t tracked = 0;
  frames([&](const DepthFrame& frame) {
    if (tracked++ < kMostOthers) collector.add(frame, tracker.process(frame));
  });
  return {collector.chosen(kOtherFrames), tracker.actor().stature_m()};
}

Actor CalibrationRun::solveByTPose(const Frames& others) {
  Actor actor;
  solve_s_ = secondsOf([&] { actor = calibrator_.solve(); });
  if (config_.tpose_only || calibrator_.hadCompany()) return actor;
  const OtherPoses found = track(others, asSeen(actor), 0);
  return found.observations.size() >= kFewestOthers ? calibrator_.solve(found.observations) : actor;
}

// Tracked twice: once to learn the size, once with it.
Actor CalibrationRun::solveByAnyPose(const Frames& frames) {
  const double stature_m = track(frames, std::nullopt, 0).stature_m;
  const OtherPoses found = track(frames, std::nullopt, stature_m);
  Actor actor;
  solve_s_ = secondsOf([&] { actor = calibrator_.solveWithoutTPose(found.observations, found.stature_m); });
  return actor;
}

Actor CalibrationRun::solve(const Frames& others) {
  Actor actor = config_.calibrator.any_pose ? solveByAnyPose(others) : solveByTPose(others);
  ActorMeasurement measured = *actor.measured;
  measured.camera = config_.camera_name;
  actor.measured = std::make_shared<const ActorMeasurement>(std::move(measured));
  return actor;
}

}  // namespace depthmocap

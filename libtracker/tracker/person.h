#pragma once
#include <optional>

#include "depthmocap/models.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/tracker/observer.h"
#include "libtracker/tracker/pose_fitter.h"
#include "libtracker/tracker/stage_clock.h"
#include "libtracker/tracker/track_memory.h"
#include "libtracker/tracker/upright_world.h"

namespace depthmocap {

// One person who is tracked: what is remembered of the person, and the stages from pixels to a pose.
class Person {
 public:
  // `number`: 1, 2, ...
  Person(int number, const Models& models, const CameraModel& camera, const TrackerConfig& config,
         const std::optional<Actor>& given);

  // What to expect of the frame; before its segmentation, and again where the world was turned.
  const Prediction& predict(const DepthFrame& frame, const UprightWorld& world);
  // (1) to (5): the pose in this frame.
  void track(const DepthFrame& frame, const PersonRegion& region, const UprightWorld& world, StageClock& clock);

  // The next frame is the first one of another run.
  void forget() {
    memory.forget(std::nullopt);
    fitter_.forget();
  }

  TrackMemory memory;
  Observer observer;
  TrackedFrame out;
  NormalEquations evidence;  // of the pose in `out` where it was found in this frame: see Hypothesis

 private:
  void begin(const DepthFrame& frame);
  void rest(const PersonRegion& region, const UprightWorld& world);
  std::optional<Hypothesis> fit(const PersonRegion& region);
  void observeBody(Hypothesis& pose);
  std::optional<Hypothesis> fitFromAnySide(const FacingShares& shares, const BodyAdapter& body);
  std::optional<Hypothesis> turnAround(const Hypothesis& tracked);
  std::optional<Hypothesis> startAnew(const Hypothesis& tracked);
  std::optional<Hypothesis> adopt(std::optional<Hypothesis> found);
  [[nodiscard]] bool showsABody(const Hypothesis& pose);
  [[nodiscard]] bool enough(const PersonRegion& region) const;
  void report(const PersonRegion& region, const UprightWorld& world, const std::optional<Hypothesis>& pose);

  const TrackerConfig config_;
  const CameraModel camera_;
  PoseFitter fitter_;

  // Of the present frame.
  Prediction prediction_;
  Eigen::Matrix3d R_world_camera_ = uprightWorldFromCamera();
  Evidence evidence_;
  Evidence supposed_;  // the same, seen from a side that is tried
  Evidence best_;      // from the best side that was tried, after fitFromAnySide()
  ForwardKinematics fk_;
};

}  // namespace depthmocap

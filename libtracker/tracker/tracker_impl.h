#pragma once
#include <optional>

#include "depthmocap/tracker.h"
#include "libtracker/tracker/observer.h"
#include "libtracker/tracker/pose_fitter.h"
#include "libtracker/tracker/track_memory.h"
#include "libtracker/tracker/upright_world.h"

namespace depthmocap {

// The stages and what they hand to each other.
struct Tracker::Impl {
  Impl(const Models& models, const CameraModel& camera, const TrackerConfig& config, const std::optional<Actor>& given);

  void begin(const DepthFrame& frame);
  std::optional<Hypothesis> fit(const PersonRegion& person, const Prediction& prediction);
  std::optional<Hypothesis> fitFromAnySide(const FacingShares& shares, const SizeAdapter& body);
  std::optional<Hypothesis> turnAround(const Hypothesis& tracked, const Prediction& prediction);
  std::optional<Hypothesis> adopt(std::optional<Hypothesis> found);
  [[nodiscard]] bool enough(const PersonRegion& person) const;
  void report(const PersonRegion& person, const std::optional<Hypothesis>& pose);

  const TrackerConfig config;
  UprightWorld world;
  Observer observer;
  TrackMemory memory;
  PoseFitter fitter;

  // Working memory.
  Evidence evidence;  // of the present frame
  Evidence supposed;  // the same, seen from a side that is tried
  Evidence best;      // from the best side that was tried, after fitFromAnySide()
  TrackedFrame out;
  ForwardKinematics fk;
};

}  // namespace depthmocap

#pragma once
#include <memory>
#include <vector>

#include "depthmocap/tracker.h"
#include "libtracker/tracker/person.h"
#include "libtracker/tracker/returning_people.h"
#include "libtracker/tracker/scene_observer.h"

namespace depthmocap {

// The scene and the people in it.
struct Tracker::Impl {
  Impl(const Models& models, const CameraModel& camera, const TrackerConfig& config, const std::optional<Actor>& given);

  void predict(const DepthFrame& frame);
  void turnWorld(const Eigen::Matrix3d& R_new_before, const DepthFrame& frame);
  [[nodiscard]] Person& person(int number) const;  // throws Error where there is no such person

  SceneObserver scene;
  ReturningPeople returning;
  std::vector<std::unique_ptr<Person>> people;
  ExpectedPeople expected;                 // of the present frame, by place in the scene
  std::vector<const TrackedFrame*> found;  // of the present frame, one per person
};

}  // namespace depthmocap

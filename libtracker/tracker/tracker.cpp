#include "depthmocap/tracker.h"

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check_camera.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/skeleton/check_skeleton.h"
#include "libtracker/tracker/stage_clock.h"
#include "libtracker/tracker/tracker_impl.h"

namespace depthmocap {
namespace {

void checkModels(const Models& models) {
  const char* advice = "take Models::shipped(), or Models::load() with files of your own";
  if (!models.classifier) throw Error("the part classifier is missing", "Models", advice);
  if (!models.room) throw Error("the room classifier is missing", "Models", advice);
  if (!models.database || models.database->poses.empty()) throw Error("there is no pose in it", "Models", advice);
}

void checkActor(const Actor& actor) {
  const char* advice = "take averageActor(), readActorFile() or a calibration's";
  if (!actor.surface) throw Error("the actor has no surface", "Actor", advice);
  checkSkeleton(actor.skeleton, "Actor");
}

}  // namespace

Tracker::Tracker(const Models& models, const CameraModel& camera, const std::optional<Actor>& actor)
    : Tracker(models, camera, TrackerConfig{}, actor) {}

Tracker::Tracker(const Models& models, const CameraModel& camera, const TrackerConfig& config,
                 const std::optional<Actor>& actor) {
  checkModels(models);
  checkCamera(camera, "CameraModel");
  if (actor) checkActor(*actor);
  config.validate();
  impl_ = std::make_unique<Impl>(models, camera, config, actor);
}

Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

const Actor& Tracker::actor(int person) const {
  return impl_->person(person).memory.actor();
}

void Tracker::reset() {
  for (const auto& person : impl_->people) person->forget();
  impl_->returning.forget();
}

void Tracker::lockOn(const Eigen::Vector3d& p_camera, int person) {
  if (!p_camera.allFinite()) throw Error("the point is no number", "Tracker::lockOn");
  impl_->person(person).memory.forget(p_camera);
}

void Tracker::use(const Actor& actor, int person) {
  checkActor(actor);
  impl_->person(person).memory.use(actor);
}

std::span<const TrackedFrame* const> Tracker::people() const {
  return impl_->found;
}

const TrackedFrame& Tracker::process(const DepthFrame& frame) {
  Impl& t = *impl_;
  checkFrame(frame, t.scene.camera());
  StageClock clock(t.people.front()->out.ms);
  t.predict(frame);

  // (0) who is where
  const Segmentation& seen = t.scene.segment(frame, t.expected);
  t.returning.assign(t.expected, seen, frame.depth);
  if (const auto turn = t.scene.world.observe(seen)) t.turnWorld(*turn, frame);
  clock.lap(&StageTimes::segment);

  // (1) to (5) the pose of each person
  for (std::size_t i = 0; i < t.people.size(); ++i) {
    Person& person = *t.people[i];
    if (i > 0) clock.follow(person.out.ms);
    person.track(frame, seen.people[t.returning.placeOf(i)], t.scene.world, clock);
    if (person.out.state == TrackState::Tracking) t.returning.observe(i, seen, frame.depth);
  }
  return t.people.front()->out;
}

Tracker::Impl::Impl(const Models& models, const CameraModel& camera, const TrackerConfig& config,
                    const std::optional<Actor>& given)
    : scene(models, camera, config),
      returning(static_cast<std::size_t>(config.people), camera),
      expected(static_cast<std::size_t>(config.people)) {
  for (int number = 1; number <= config.people; ++number) {
    people.push_back(std::make_unique<Person>(number, models, camera, config, number == 1 ? given : std::nullopt));
    found.push_back(&people.back()->out);
  }
}

Person& Tracker::Impl::person(int number) const {
  if (number >= 1 && static_cast<std::size_t>(number) <= people.size())
    return *people[static_cast<std::size_t>(number - 1)];
  throw Error(fmt::format("there is no person {}, {} are tracked", number, people.size()), "Tracker",
              "people count from 1");
}

void Tracker::Impl::predict(const DepthFrame& frame) {
  for (std::size_t i = 0; i < people.size(); ++i) {
    expected[returning.placeOf(i)] = people[i]->predict(frame, scene.world).actor;
  }
}

void Tracker::Impl::turnWorld(const Eigen::Matrix3d& R_new_before, const DepthFrame& frame) {
  for (const auto& person : people) {
    person->memory.turnWorld(R_new_before);
    person->predict(frame, scene.world);
  }
}

}  // namespace depthmocap

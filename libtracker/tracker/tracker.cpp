#include "depthmocap/tracker.h"

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/tracker/stage_clock.h"
#include "libtracker/tracker/tracker_impl.h"

namespace depthmocap {
namespace {

void checkModels(const Models& models) {
  const char* advice = "take Models::shipped(), or Models::load() with files of your own";
  if (!models.classifier) throw Error("the part classifier is missing", "Models", advice);
  if (!models.database || models.database->poses.empty()) throw Error("there is no pose in it", "Models", advice);
}

void checkCamera(const CameraModel& camera) {
  if (camera.width > 0 && camera.height > 0 && camera.fx > 0 && camera.fy > 0) return;
  throw Error(
      fmt::format("{}x{} with focal lengths {} and {} is no camera", camera.width, camera.height, camera.fx, camera.fy),
      "CameraModel", "take the camera of the recording or of the source");
}

void checkActor(const std::optional<Actor>& actor) {
  if (!actor || actor->surface) return;
  throw Error("the actor has no surface", "Actor", "take averageActor(), readActorFile() or a calibration's");
}

void checkSize(const DepthFrame& frame, const CameraModel& camera) {
  if (frame.depth.width == camera.width && frame.depth.height == camera.height) return;
  throw Error(fmt::format("the image is {}x{}, the camera's are {}x{}", frame.depth.width, frame.depth.height,
                          camera.width, camera.height),
              fmt::format("frame {}", frame.frame), "construct a Tracker with this camera's model");
}

}  // namespace

Tracker::Tracker(const Models& models, const CameraModel& camera, const std::optional<Actor>& actor)
    : Tracker(models, camera, TrackerConfig{}, actor) {}

Tracker::Tracker(const Models& models, const CameraModel& camera, const TrackerConfig& config,
                 const std::optional<Actor>& actor) {
  checkModels(models);
  checkCamera(camera);
  checkActor(actor);
  config.validate();
  impl_ = std::make_unique<Impl>(models, camera, config, actor);
}

Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

const Actor& Tracker::actor() const {
  return impl_->memory.actor();
}

void Tracker::reset() {
  impl_->memory.forget(std::nullopt);
}

void Tracker::lockOn(const Eigen::Vector3d& p_camera) {
  impl_->memory.forget(p_camera);
}

void Tracker::use(const Actor& actor) {
  checkActor(actor);
  impl_->memory.use(actor);
}

// The method on one page (Su, Chai, Xia 2016); equation numbers as in docs/architecture.md.
const TrackedFrame& Tracker::process(const DepthFrame& frame) {
  Impl& t = *impl_;
  checkSize(frame, t.observer.camera());
  StageClock clock(t.out.ms);
  t.begin(frame);
  Prediction prediction = t.memory.predict(frame.time_s, t.world.R_world_camera());

  const Segmentation& seen = t.observer.segment(frame, prediction);
  if (const auto turn = t.world.observe(seen)) {
    t.memory.turnWorld(*turn);
    prediction = t.memory.predict(frame.time_s, t.world.R_world_camera());
  }
  clock.lap(&StageTimes::segment);

  // (1) a body part for each pixel
  t.observer.label(frame, seen.actor(), prediction, t.evidence);
  clock.lap(&StageTimes::classify);

  // (2) one marker for each part
  t.observer.locate(t.memory.actor().radii_m, &prediction, t.world.R_world_camera(), t.evidence);
  clock.lap(&StageTimes::markers);

  // (3) nearest poses in the database, (4) local linear model over them
  if (prediction.has_pose && t.enough(seen.actor())) t.fitter.buildPrior(t.evidence, prediction, t.memory.actor());
  clock.lap(&StageTimes::prior);

  // (5) maximum a posteriori pose
  t.fitter.look(frame.depth, seen.actor(), t.observer.camera(), t.world.R_world_camera());
  const std::optional<Hypothesis> pose = t.fit(seen.actor(), prediction);
  pose ? t.memory.accept(*pose, prediction, t.world.floor()) : t.memory.miss(prediction);
  t.report(seen.actor(), pose);
  clock.lap(&StageTimes::solve);
  return t.out;
}

}  // namespace depthmocap

#include "libtracker/tracker/tracker.h"

#include <utility>

#include "libtracker/tracker/stage_clock.h"
#include "libtracker/tracker/tracker_stages.h"

namespace depthmocap {

Tracker::Tracker(std::shared_ptr<const TrackerModels> models, const CameraModel& camera, const TrackerConfig& config,
                 const std::optional<ActorModel>& actor)
    : stages_(std::make_unique<Stages>(std::move(models), camera, config, actor)) {}

Tracker::~Tracker() = default;

const ActorModel& Tracker::actor() const {
  return stages_->size.actor();
}

void Tracker::reset() {
  stages_->history = {};
  stages_->size = stages_->first_size;
  stages_->wanted_camera.reset();
}

void Tracker::lockOn(const Eigen::Vector3d& p_camera) {
  reset();
  stages_->wanted_camera = p_camera;
}

void Tracker::use(std::shared_ptr<const TrackerModels> models, const ActorModel& actor) {
  next_stages_ = std::make_unique<Stages>(std::move(models), stages_->camera, stages_->config, actor);
}

// The method on one page (Su, Chai, Xia 2016); equation numbers as in docs/architecture.md.
const TrackedFrame& Tracker::process(const DepthFrame& frame, const KnownEvidence& known) {
  if (next_stages_) stages_ = std::move(next_stages_);
  Stages& s = *stages_;
  StageClock clock(s.out.ms);
  s.begin(frame, known);

  s.segmenter.segment(frame.depth, s.camera, s.expected_actor ? &*s.expected_actor : nullptr, s.segmentation);
  s.levelWorld();
  clock.lap(&StageTimes::segment);

  // (1) a body part for each pixel
  s.labelPixels(frame.depth);
  clock.lap(&StageTimes::classify);

  // (2) one marker for each part
  s.findMarkers(s.predicted ? &s.predicted_camera : nullptr);
  clock.lap(&StageTimes::markers);

  // (3) nearest poses in the database, (4) local linear model over them
  s.buildPrior();
  clock.lap(&StageTimes::prior);

  // (5) maximum a posteriori pose
  s.solve(frame.depth);
  s.finish();
  clock.lap(&StageTimes::solve);
  return s.out;
}

}  // namespace depthmocap

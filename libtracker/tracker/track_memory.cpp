#include "libtracker/tracker/track_memory.h"

#include <limits>

#include "libtracker/actor/make_actor.h"
#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

constexpr float kDisputedShare = 0.01F;  // a side that the image gives less is disputed
constexpr int kDisputePatience = 3;      // [frames] of dispute before other sides are tried for the first time
constexpr int kDisputePeriod = 15;       // [frames] of dispute between two trials of other sides
constexpr int kPuzzledPatience = 2;      // [frames] of much unexplained before the image alone is asked, and
constexpr int kPuzzledPeriod = 5;        // [frames] from then on between two trials

BodyAdapter firstBody(const TrackPolicy& policy, const std::optional<Actor>& given) {
  return {given ? *given : averageActor(averageBoneLengths(policy.assumed_stature_m)), given.has_value(),
          policy.adapt_s, policy.shape_s};
}

}  // namespace

TrackMemory::TrackMemory(const TrackPolicy& policy, const std::optional<Actor>& given)
    : policy_(policy), first_body_(firstBody(policy, given)), body_(first_body_) {}

Prediction TrackMemory::predict(double time_s, const Eigen::Matrix3d& R_world_camera) {
  Prediction prediction;
  prediction.time_s = time_s;
  prediction.dt_s = time_s_ > 0 ? time_s - time_s_ : 0.0;
  prediction.has_pose = history_.hasPose();
  if (prediction.has_pose) {
    prediction.q = history_.predicted(time_s);
    prediction.q_prev = history_.prev();
    prediction.q_prev2 = history_.prev2(time_s);
    prediction.markers_camera = rotated(R_world_camera.transpose(), modelMarkers(actor(), prediction.q, fk_));
    prediction.joints_camera = R_world_camera.transpose() * jointPositions(actor().skeleton, prediction.q);
    trunk_camera_ = prediction.markers_camera.position.col(partIndex(Part::Torso));
  }
  prediction.actor = expectedActor(time_s, R_world_camera);
  if (prediction.actor && prediction.has_pose) {
    const Eigen::Vector3d moved = prediction.actor->p_camera - trunk_camera_;
    prediction.actor->joints_camera = prediction.joints_camera.colwise() + moved;
  }
  return prediction;
}

std::optional<ExpectedActor> TrackMemory::expectedActor(double time_s, const Eigen::Matrix3d& R_world_camera) {
  const double unseen_s = history_.unseen(time_s);
  if (wanted_camera_) return ExpectedActor{*wanted_camera_, std::numeric_limits<double>::infinity()};
  if (history_.state() == TrackState::Tracking) return ExpectedActor{trunk_camera_, unseen_s};
  if (unseen_s <= policy_.absent_s) {
    return ExpectedActor{trunk_camera_ + R_world_camera.transpose() * history_.walkedOn(time_s), unseen_s};
  }
  history_ = {};
  if (body_.isFitted()) fitted_body_ = body_.fixed();
  body_ = first_body_;
  return std::nullopt;
}

void TrackMemory::accept(const Hypothesis& pose, const Prediction& prediction,
                         const std::optional<Eigen::Vector4d>& floor_world) {
  time_s_ = prediction.time_s;
  wanted_camera_.reset();
  history_.accept(pose.q, prediction.time_s, pose.fresh);
  if (pose.body) {
    body_ = *pose.body;
    disputed_frames_ = puzzled_frames_ = 0;
  }
  if (pose.size) body_.observeSize(pose.size->scale, pose.size->is_sure ? prediction.dt_s : 0.0);
  if (pose.shape) body_.observeShape(*pose.shape, prediction.dt_s);
  if (pose.fresh) return feet_.reset();
  feet_.observe(actor().skeleton, pose.q, prediction.time_s, floor_world);
}

void TrackMemory::miss(const Prediction& prediction) {
  time_s_ = prediction.time_s;
  history_.miss(prediction.time_s, policy_.coast_s);
  feet_.reset();
}

void TrackMemory::turnWorld(const Eigen::Matrix3d& R_new_before) {
  history_.turnWorld(R_new_before);
  feet_.reset();
}

bool TrackMemory::dispute(float share) {
  disputed_frames_ = share < kDisputedShare ? disputed_frames_ + 1 : 0;
  return disputed_frames_ % kDisputePeriod == kDisputePatience;
}

bool TrackMemory::puzzled(bool much) {
  puzzled_frames_ = much ? puzzled_frames_ + 1 : 0;
  return puzzled_frames_ % kPuzzledPeriod == kPuzzledPatience;
}

void TrackMemory::forget(const std::optional<Eigen::Vector3d>& wanted_camera) {
  history_ = {};
  body_ = first_body_;
  wanted_camera_ = wanted_camera;
}

void TrackMemory::keepBody() {
  if (body_.isFitted()) fitted_body_ = body_.fixed();
  if (fitted_body_) first_body_ = *fitted_body_;
}

void TrackMemory::use(const Actor& actor) {
  first_body_ = body_ = {actor, true, policy_.adapt_s, policy_.shape_s};
}

}  // namespace depthmocap

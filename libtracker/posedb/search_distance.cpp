#include "libtracker/posedb/search_distance.h"

#include "libtracker/posedb/best_rotation.h"
#include "libtracker/skeleton/local_prior.h"

namespace depthmocap {

void SearchDistance::setQuery(const PoseQuery& query) {
  weight_.setZero();
  weight_.head<kPartCount>() = query.markers.confidence.cwiseMax(0.0).cast<float>().array();
  const float total = weight_.sum();
  has_markers_ = total > 0;
  share_ = has_markers_ ? MarkerLane(weight_ / total) : MarkerLane::Zero();
  centred_.setZero();
  for (int i = 0; i < kPartCount; ++i) {
    if (!query.markers.seen(i)) continue;  // the position of an unseen marker may be anything
    centred_.row(i) = (query.markers.position.col(i) / query.scale).cast<float>().transpose().array();
  }
  for (int axis = 0; axis < 3; ++axis) {
    centred_.col(axis) -= (share_ * centred_.col(axis)).sum();
    shared_.col(axis) = share_ * centred_.col(axis);
  }
  has_history_ = query.has_history;
  expected_.setZero();
  for (int dof : kShapeDofs) expected_[dof] = static_cast<float>(2.0 * query.q_prev[dof] - query.q_prev2[dof]);
}

double SearchDistance::operator()(std::uint32_t n) const {
  double distance = has_markers_ ? config_.alpha * markerDistance(n) : 0.0;
  if (has_history_) distance += config_.beta * static_cast<double>((database_.poses[n] - expected_).squaredNorm());
  return distance;
}

double SearchDistance::markerDistance(std::size_t n) const {
  Eigen::Array<float, kMarkerLanes, 3> a;
  Eigen::Matrix3d S;
  for (int axis = 0; axis < 3; ++axis) {
    const auto lane = table_.lane(n, axis);
    a.col(axis) = lane - (share_ * lane).sum();
    for (int other = 0; other < 3; ++other) {
      S(axis, other) = static_cast<double>((lane * shared_.col(other)).sum());
    }
  }
  const Eigen::Matrix3f R = (config_.upright_alignment ? bestRotationAboutY(S) : bestRotation(S)).cast<float>();
  MarkerLane e2 = MarkerLane::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    e2 += (a.col(axis) - R(axis, 0) * centred_.col(0) - R(axis, 1) * centred_.col(1) - R(axis, 2) * centred_.col(2))
              .square();
  }
  const auto per_e2 = static_cast<float>(1.0 / (2.0 * config_.sigma_m * config_.sigma_m));
  return static_cast<double>((weight_ * (1.0F + per_e2 * e2).log()).sum());
}

}  // namespace depthmocap

#include "libtracker/ik/target_term.h"

#include <cmath>

#include "libtracker/core/check.h"
#include "libtracker/posedb/best_rotation.h"

namespace depthmocap {

TargetTerm::TargetTerm(const Skeleton& skeleton, const JointTargets& targets) : skeleton_(skeleton) {
  const auto points = jointPoints(skeleton);
  for (int joint = 0; joint < kJointCount; ++joint) {
    if (!targets.has(static_cast<Joint>(joint))) continue;
    points_.push_back(points[static_cast<std::size_t>(joint)]);
    goals_.emplace_back(targets.p_world.col(joint));
  }
  DMC_CHECK(!points_.empty());
}

void TargetTerm::evaluate(const Pose& q, Eigen::Ref<Eigen::VectorXd> r,
                          Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>* J) {
  fk_.update(skeleton_, q);
  PointJacobian point_jacobian;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(3 * i);
    r.segment<3>(row) = fk_.position(points_[i]) - goals_[i];
    if (J == nullptr) continue;
    fk_.jacobian(points_[i], point_jacobian);
    J->middleRows<3>(row) = point_jacobian;
  }
}

double TargetTerm::rms(const Pose& q) {
  Eigen::VectorXd r(rows());
  evaluate(q, r, nullptr);
  return std::sqrt(r.squaredNorm() / static_cast<double>(points_.size()));
}

Pose placedAtTargets(const Skeleton& skeleton, const JointTargets& targets, const Pose& shape) {
  Pose q = shape;
  q.head<3>().setZero();
  q[kRootRy] = 0;
  const JointPositions joints = jointPositions(skeleton, q);
  Eigen::Vector3d joint_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal_mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < kJointCount; ++i) {
    if (!targets.has(static_cast<Joint>(i))) continue;
    joint_mean += joints.col(i) / targets.count();
    goal_mean += targets.p_world.col(i) / targets.count();
  }
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kJointCount; ++i) {
    if (!targets.has(static_cast<Joint>(i))) continue;
    S += (targets.p_world.col(i) - goal_mean) * (joints.col(i) - joint_mean).transpose();
  }
  const Eigen::Matrix3d R = bestRotationAboutY(S);
  // The heading is applied last, so it turns the joints about the vertical through the root.
  q[kRootRy] = std::atan2(R(0, 2), R(0, 0));
  q.head<3>() = goal_mean - R * joint_mean;
  return q;
}

}  // namespace depthmocap

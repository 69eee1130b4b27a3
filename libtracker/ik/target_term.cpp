#include "libtracker/ik/target_term.h"

#include <cmath>
#include <utility>

#include "libtracker/core/check.h"
#include "libtracker/posedb/best_rotation.h"

namespace depthmocap {

PointTargets pointTargets(const Skeleton& skeleton, const JointTargets& targets) {
  const auto points = jointPoints(skeleton);
  PointTargets result;
  for (int joint = 0; joint < kJointCount; ++joint) {
    const auto i = static_cast<std::size_t>(joint);
    if (!targets.given[i]) continue;
    result.targets.push_back({points[i], targets.p_world.col(joint), targets.weight[i]});
  }
  return result;
}

TargetTerm::TargetTerm(const Skeleton& skeleton, PointTargets targets)
    : skeleton_(skeleton), targets_(std::move(targets)) {
  DMC_CHECK(!targets_.targets.empty());
}

void TargetTerm::evaluate(const Pose& q, Eigen::Ref<Eigen::VectorXd> r, RowsJacobian* J) {
  fk_.update(skeleton_, q);
  PointJacobian point_jacobian;
  Eigen::Index row = 0;
  for (const PointTargets::Target& target : targets_.targets) {
    r.segment<3>(row) = target.weight * (fk_.position(target.point) - target.goal);
    if (J != nullptr) {
      fk_.jacobian(target.point, point_jacobian);
      J->middleRows<3>(row) = target.weight * point_jacobian;
    }
    row += 3;
  }
}

double TargetTerm::rms(const Pose& q) {
  fk_.update(skeleton_, q);
  double sum = 0;
  for (const PointTargets::Target& target : targets_.targets) {
    sum += (fk_.position(target.point) - target.goal).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(targets_.targets.size()));
}

Pose placedAtTargets(const Skeleton& skeleton, const PointTargets& targets, const Pose& shape) {
  Pose q = shape;
  q.head<3>().setZero();
  q[kRootRy] = 0;
  ForwardKinematics fk;
  fk.update(skeleton, q);
  double weight = 0;
  Eigen::Vector3d point_mean = Eigen::Vector3d::Zero();
  Eigen::Vector3d goal_mean = Eigen::Vector3d::Zero();
  for (const PointTargets::Target& target : targets.targets) {
    weight += target.weight;
    point_mean += target.weight * fk.position(target.point);
    goal_mean += target.weight * target.goal;
  }
  point_mean /= weight;
  goal_mean /= weight;
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  for (const PointTargets::Target& target : targets.targets) {
    S += target.weight * (target.goal - goal_mean) * (fk.position(target.point) - point_mean).transpose();
  }
  const Eigen::Matrix3d R = bestRotationAboutY(S);
  // The heading is applied last, so it turns the points about the vertical through the root.
  q[kRootRy] = std::atan2(R(0, 2), R(0, 0));
  q.head<3>() = goal_mean - R * point_mean;
  return q;
}

}  // namespace depthmocap

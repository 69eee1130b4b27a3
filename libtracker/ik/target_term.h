#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "depthmocap/joint_targets.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

// The first rows of (3.1) of MNN-IK: f_i(q) - c_i [m], three a target, in the order of kJointNames.
class TargetTerm {
 public:
  TargetTerm(const Skeleton& skeleton, const JointTargets& targets);  // the skeleton must outlive the term

  [[nodiscard]] int rows() const { return 3 * static_cast<int>(points_.size()); }
  // r: rows(); J: rows() x kDofCount or nullptr.
  void evaluate(const Pose& q, Eigen::Ref<Eigen::VectorXd> r, Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>* J);
  // Root mean square distance [m] at q.
  [[nodiscard]] double rms(const Pose& q);

  // The targets as points on bones, and where they should be [m].
  [[nodiscard]] const std::vector<BonePoint>& points() const { return points_; }
  [[nodiscard]] const std::vector<Eigen::Vector3d>& goals() const { return goals_; }

 private:
  const Skeleton& skeleton_;
  std::vector<BonePoint> points_;
  std::vector<Eigen::Vector3d> goals_;
  ForwardKinematics fk_;
};

// The pose `shape` (its place and heading do not count) turned about the vertical and moved so that its joints lie
// nearest to the targets, by least squares.
Pose placedAtTargets(const Skeleton& skeleton, const JointTargets& targets, const Pose& shape);

}  // namespace depthmocap

#pragma once
#include <Eigen/Core>
#include <vector>

#include "depthmocap/joint_targets.h"
#include "libtracker/ik/pose_term.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {

// Points of a body and where they should be.
struct PointTargets {
  struct Target {
    BonePoint point;
    Eigen::Vector3d goal = Eigen::Vector3d::Zero();  // [m] y up
    double weight = 1;                               // (> 0) of the distance
  };
  std::vector<Target> targets;
};

// The joints that are given, in the order of kJointNames.
PointTargets pointTargets(const Skeleton& skeleton, const JointTargets& targets);

// weight_i (f_i(q) - c_i) [m], three rows a target.
class TargetTerm final : public PoseTerm {
 public:
  TargetTerm(const Skeleton& skeleton, PointTargets targets);  // the skeleton must outlive the term
  TargetTerm(const Skeleton& skeleton, const JointTargets& targets)
      : TargetTerm(skeleton, pointTargets(skeleton, targets)) {}

  [[nodiscard]] int rows() const override { return 3 * static_cast<int>(targets_.targets.size()); }
  void evaluate(const Pose& q, Eigen::Ref<Eigen::VectorXd> r, RowsJacobian* J) override;
  // Root mean square distance [m] at q, whatever the weights.
  [[nodiscard]] double rms(const Pose& q);

  [[nodiscard]] const std::vector<PointTargets::Target>& targets() const { return targets_.targets; }

 private:
  const Skeleton& skeleton_;
  PointTargets targets_;
  ForwardKinematics fk_;
};

// The pose `shape` (its place and heading do not count) turned about the vertical and moved so that its points lie
// nearest to the targets, by weighted least squares. At least one target.
Pose placedAtTargets(const Skeleton& skeleton, const PointTargets& targets, const Pose& shape);

}  // namespace depthmocap

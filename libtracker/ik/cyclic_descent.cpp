#include <cmath>

#include "libtracker/ik/classic_solvers.h"
#include "libtracker/ik/target_term.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

constexpr int kMaxSweeps = 100;
constexpr double kLeastGain_m = 1e-6;  // of a sweep
constexpr int kMaxHalvings = 4;        // of a turn that leads away

bool isMovedBy(Bone point_bone, int bone) {
  int at = static_cast<int>(point_bone);
  while (at > bone) at = kBoneParents[static_cast<std::size_t>(at)];
  return at == bone;
}

class Descent {
 public:
  Descent(const Skeleton& skeleton, const JointTargets& targets, const Pose& start)
      : skeleton_(skeleton), term_(skeleton, targets), q_(start), squared_(squaredAt(start)) {}

  void sweep() {
    for (int bone = kBoneCount - 1; bone >= 0; --bone) {
      const BoneDofs& dofs = kBoneDofs[static_cast<std::size_t>(bone)];
      for (int dof = dofs.first; dof < dofs.first + dofs.count; ++dof) turn(bone, dof);
    }
    move();
  }
  [[nodiscard]] const Pose& q() const { return q_; }
  [[nodiscard]] double rms() const { return std::sqrt(squared_ / static_cast<double>(term_.targets().size())); }

 private:
  // The sum of squared distances of the targets [m^2]; leaves the kinematics there.
  double squaredAt(const Pose& pose) {
    fk_.update(skeleton_, pose);
    double sum = 0;
    for (const PointTargets::Target& target : term_.targets()) {
      sum += (fk_.position(target.point) - target.goal).squaredNorm();
    }
    return sum;
  }
  // The axis in the world, from how it moves three points of the bone: axis = 1/2 sum u_k x (axis x u_k).
  [[nodiscard]] Eigen::Vector3d axisOf(Bone bone, int dof) const {
    Eigen::Vector3d axis = Eigen::Vector3d::Zero();
    PointJacobian J;
    for (int k = 0; k < 3; ++k) {
      fk_.jacobian({bone, Eigen::Vector3d::Unit(k)}, J);
      axis += 0.5 * fk_.R_world_bone(bone).col(k).cross(J.col(dof));
    }
    return axis;
  }
  // The turn about the DoF's axis that brings the joints it moves nearest to their targets.
  [[nodiscard]] double bestTurn(int bone, int dof) const {
    const Eigen::Vector3d axis = axisOf(static_cast<Bone>(bone), dof);
    const Eigen::Vector3d& pivot = fk_.origin(static_cast<Bone>(bone));
    double across = 0;
    double along = 0;
    for (const PointTargets::Target& target : term_.targets()) {
      if (!isMovedBy(target.point.bone, bone)) continue;
      const Eigen::Vector3d arm = fk_.position(target.point) - pivot;
      const Eigen::Vector3d goal = target.goal - pivot;
      across += axis.cross(arm).dot(goal);
      along += arm.dot(goal) - axis.dot(arm) * axis.dot(goal);
    }
    return across == 0 && along == 0 ? 0 : std::atan2(across, along);
  }
  // The axis of a swing turns with the swing, so the best turn about it is a first guess only.
  void turn(int bone, int dof) {
    double angle = bestTurn(bone, dof);
    for (int halving = 0; halving <= kMaxHalvings && std::abs(angle) > 1e-9; ++halving, angle *= 0.5) {
      Pose next = q_;
      next[dof] += angle;
      next = clampedToLimits(next);
      const double squared = squaredAt(next);
      if (squared < squared_) {
        squared_ = squared;
        q_ = next;
        return;
      }
    }
    fk_.update(skeleton_, q_);
  }
  void move() {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const PointTargets::Target& target : term_.targets()) mean += target.goal - fk_.position(target.point);
    q_.head<3>() += mean / static_cast<double>(term_.targets().size());
    squared_ = squaredAt(q_);
  }

  const Skeleton& skeleton_;
  TargetTerm term_;
  ForwardKinematics fk_;
  Pose q_;
  double squared_;  // [m^2] at q_
};

}  // namespace

IkResult solveCyclicDescent(const Skeleton& skeleton, const JointTargets& targets, const Pose& q) {
  Descent descent(skeleton, targets, q);
  IkResult result{q, descent.rms(), 0};
  for (; result.iterations < kMaxSweeps; ++result.iterations) {
    descent.sweep();
    const double gain_m = result.residual_m - descent.rms();
    result.q = descent.q();
    result.residual_m = descent.rms();
    if (gain_m < kLeastGain_m) break;
  }
  return result;
}

}  // namespace depthmocap

#include "libtracker/solve/twist_equations.h"

#include <algorithm>

namespace depthmocap {
namespace {

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

}  // namespace

void TwistEquations::reset(const ForwardKinematics& fk) {
  fk_ = &fk;
  centre_ = fk.origin(Bone::Root);
  for (Sum& sum : sums_) sum = {};
}

void TwistEquations::addPoint(Bone bone, const Eigen::Vector3d& p_world, const Eigen::Vector3d& e, double k) {
  Sum& sum = sums_[static_cast<std::size_t>(bone)];
  const Eigen::Vector3d arm = p_world - centre_;
  const Eigen::Matrix3d turn = k * skew(arm);  // -turn * angular velocity is k times what the rotation moves the point
  sum.A.topLeftCorner<3, 3>().noalias() -= turn * skew(arm);
  sum.A.topRightCorner<3, 3>() += turn;
  sum.A.bottomLeftCorner<3, 3>() -= turn;
  sum.A.bottomRightCorner<3, 3>().diagonal().array() += k;
  sum.g.head<3>() += k * arm.cross(e);
  sum.g.tail<3>() += k * e;
}

void TwistEquations::addPlane(Bone bone, const Eigen::Vector3d& p_world, const Eigen::Vector3d& n_world, double off,
                              double k) {
  Sum& sum = sums_[static_cast<std::size_t>(bone)];
  Twist row;
  row << (p_world - centre_).cross(n_world), n_world;
  const Twist weighed = k * row;
  sum.A.noalias() += weighed * row.transpose();
  sum.g += off * weighed;
}

// The twist of the bone and of all behind it for a unit velocity of one of its rotational DoFs.
TwistEquations::Twist TwistEquations::twistOf(std::size_t bone, int dof) const {
  const Eigen::Vector3d& axis = fk_->axis(dof);
  Twist twist;
  twist << axis, axis.cross(centre_ - fk_->origin(static_cast<Bone>(bone)));
  return twist;
}

void TwistEquations::addTo(NormalEquations& equations) const {
  std::array<Sum, kBoneCount> composite = sums_;
  std::array<Twist, kDofCount> twists;
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    const BoneDofs& dofs = kBoneDofs[b];
    for (int i = dofs.first; i < dofs.first + dofs.count; ++i) twists[static_cast<std::size_t>(i)] = twistOf(b, i);
  }
  for (std::size_t b = kBoneCount; b-- > 0;) {
    const Sum& behind = composite[b];
    const BoneDofs& own = kBoneDofs[b];
    for (int j = own.first; j < own.first + own.count; ++j) {
      const Twist& twist = twists[static_cast<std::size_t>(j)];
      const Twist effect = behind.A * twist;
      equations.g[j] += twist.dot(behind.g);
      for (int a = static_cast<int>(b); a >= 0; a = kBoneParents[static_cast<std::size_t>(a)]) {
        const BoneDofs& dofs = kBoneDofs[static_cast<std::size_t>(a)];
        for (int i = dofs.first; i < std::min(dofs.first + dofs.count, j + 1); ++i) {
          equations.A(j, i) += twists[static_cast<std::size_t>(i)].dot(effect);
        }
      }
      equations.A.block<1, 3>(j, 0) += effect.tail<3>().transpose();
    }
    if (kBoneParents[b] < 0) continue;
    Sum& parent = composite[static_cast<std::size_t>(kBoneParents[b])];
    parent.A += behind.A;
    parent.g += behind.g;
  }
  equations.A.topLeftCorner<3, 3>() += composite[0].A.bottomRightCorner<3, 3>();
  equations.g.head<3>() += composite[0].g.tail<3>();
}

}  // namespace depthmocap

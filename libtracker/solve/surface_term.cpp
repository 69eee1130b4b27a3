#include "libtracker/solve/surface_term.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace depthmocap {
namespace {

constexpr int kFrameNumbers = 12;  // of a bone's frame: the columns of its rotation, then its origin

using FrameJacobian = Eigen::Matrix<double, kFrameNumbers, kDofCount>;

FrameJacobian frameJacobian(const ForwardKinematics& fk, Bone bone) {
  FrameJacobian J;
  PointJacobian J_origin;
  fk.jacobian({bone, Eigen::Vector3d::Zero()}, J_origin);
  for (int axis = 0; axis < 3; ++axis) {
    PointJacobian J_tip;
    fk.jacobian({bone, Eigen::Vector3d::Unit(axis)}, J_tip);
    J.middleRows<3>(Eigen::Index{3} * axis) = J_tip - J_origin;
  }
  J.bottomRows<3>() = J_origin;
  return J;
}

// B with B^T B = A; A is positive semidefinite but for rounding.
template <typename Matrix>
Matrix rootOf(const Matrix& A) {
  const Eigen::LDLT<Matrix> ldlt(A);  // A = P^T L D L^T P
  const Matrix L = ldlt.matrixL();
  const Matrix scaled = L * ldlt.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const Matrix transposed = ldlt.transpositionsP().transpose() * scaled;
  return transposed.transpose();
}

}  // namespace

SurfaceTerm::SurfaceTerm(const Skeleton& skeleton, const SurfaceMatches* matches, double lambda, double sigma_m)
    : skeleton_(skeleton) {
  if (matches == nullptr || matches->empty()) return;
  matched_ = true;
  const double scale = lambda / (2.0 * sigma_m * sigma_m);
  for (BoneForm& form : forms_) form.root.setZero();
  for (const SurfaceMatch& match : *matches) {
    BoneForm& form = forms_[static_cast<std::size_t>(match.model.bone)];
    Eigen::Matrix<double, kBoneRows, 1> a;
    for (int axis = 0; axis < 3; ++axis)
      a.segment<3>(Eigen::Index{3} * axis) = match.model.p_bone[axis] * match.n_world;
    a.segment<3>(9) = match.n_world;
    a[kFrameNumbers] = -match.n_world.dot(match.p_world);
    form.root += (scale * match.weight) * a * a.transpose();
    form.matched = true;
  }
  for (BoneForm& form : forms_) {
    if (form.matched) form.root = rootOf(form.root);
  }
}

void SurfaceTerm::evaluate(const Pose& q, ResidualRows r, JacobianRows* J) {
  r.setZero();
  if (J != nullptr) J->setZero();
  if (!matched_) return;
  fk_.update(skeleton_, q);
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    if (!forms_[b].matched) continue;
    const auto bone = static_cast<Bone>(b);
    const auto first = static_cast<Eigen::Index>(b) * kBoneRows;
    const BoneMatrix& root = forms_[b].root;
    Eigen::Matrix<double, kBoneRows, 1> frame;
    for (int axis = 0; axis < 3; ++axis) frame.segment<3>(Eigen::Index{3} * axis) = fk_.R_world_bone(bone).col(axis);
    frame.segment<3>(9) = fk_.origin(bone);
    frame[kFrameNumbers] = 1.0;
    r.segment<kBoneRows>(first) = root.lazyProduct(frame);
    if (J != nullptr) {
      J->middleRows<kBoneRows>(first) = root.leftCols<kFrameNumbers>().lazyProduct(frameJacobian(fk_, bone));
    }
  }
}

}  // namespace depthmocap

#pragma once
#include "libtracker/skeleton/local_prior.h"
#include "libtracker/solve/residual_block.h"

namespace depthmocap {

// lambda1 E_prior of equation (5): lambda * || (I - P P^T)(q - q_mean) ||^2, the squared distance [rad^2] from q to the
// local affine subspace, over kShapeDofs. One row a shape DoF. (The paper writes P^T P; its P holds the components as
// rows.)
class PriorTerm {
 public:
  static constexpr int kRows = kShapeDofCount;

  PriorTerm(const LocalPrior* prior, double lambda);  // nullptr: no term; copies what it needs
  void evaluate(const Pose& q, ResidualRows r, JacobianRows* J) const;

 private:
  using ShapeVector = Eigen::Matrix<double, kRows, 1>;
  Eigen::Matrix<double, kRows, kRows> off_subspace_;  // sqrt(lambda) (I - P P^T)
  ShapeVector mean_;
};

}  // namespace depthmocap

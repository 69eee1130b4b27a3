#pragma once
#include "libtracker/skeleton/local_prior.h"
#include "libtracker/solve/residual_block.h"

namespace depthmocap {

// lambda1 E_prior of equation (5): lambda * || (I - P S P^T)(q - q_mean) ||^2, [rad^2], over kShapeDofs. One row a
// shape DoF. For the paper's model S = I: the squared distance from q to the local affine subspace. (The paper writes
// P^T P; its P holds the components as rows.) For a Gaussian S takes from each direction what its deviation s makes
// likely, so that lambda r^2 / (s^2 + r^2) is left: r^2 lambda times the squared Mahalanobis distance, r the residual's
// deviation.
class PriorTerm {
 public:
  static constexpr int kRows = kShapeDofCount;

  PriorTerm(const LocalPrior* prior, double lambda);  // nullptr: no term; copies what it needs
  void evaluate(const Pose& q, ResidualRows r, JacobianRows* J) const;

 private:
  using ShapeVector = Eigen::Matrix<double, kRows, 1>;
  Eigen::Matrix<double, kRows, kRows> off_model_;  // sqrt(lambda) (I - P S P^T)
  ShapeVector mean_;
};

}  // namespace depthmocap

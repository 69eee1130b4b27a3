#pragma once
#include "libtracker/skeleton/local_prior.h"
#include "libtracker/skeleton/normal_equations.h"

namespace depthmocap {

// lambda1 E_prior of equation (5): lambda * || (I - P S P^T)(q - q_mean) ||^2, [rad^2], over kShapeDofs. For
// the paper's model S = I: the squared distance from q to the local affine subspace. (The paper writes
// P^T P; its P holds the components as rows.) For a Gaussian S takes from each direction what its deviation s makes
// likely, so that lambda r^2 / (s^2 + r^2) is left: r^2 lambda times the squared Mahalanobis distance, r the residual's
// deviation.
//
// Beyond that: the covariance of a few neighbours is an estimate, and tells too little where the database holds nothing
// alike. With `freedom` n > 0 the Gaussian becomes a Student distribution with n degrees of freedom, that of a Gaussian
// of unknown scale: a pose that the image pulls far away is held less.
class PriorTerm {
 public:
  // nullptr: no term; copies what it needs. freedom (>= 0) 0: a Gaussian; a subspace has none.
  PriorTerm(const LocalPrior* prior, double lambda, double freedom);

  [[nodiscard]] double energy(const Pose& q) const;
  void addTo(const Pose& q, NormalEquations& equations) const;

 private:
  using ShapeVector = Eigen::Matrix<double, kShapeDofCount, 1>;
  [[nodiscard]] ShapeVector offset(const Pose& q) const;  // [rad] from the mean
  // Of weight_'s quadratic form: what its value is worth, and how much less its slope is.
  [[nodiscard]] double eased(double quadratic) const;
  [[nodiscard]] double easing(double quadratic) const;

  double freedom_ = 0;
  double unit_ = 0;  // weight_'s quadratic form at a Mahalanobis distance of 1
  Eigen::Matrix<double, kShapeDofCount, kShapeDofCount> weight_;  // lambda (I - P S P^T)^2
  ShapeVector mean_;
};

}  // namespace depthmocap

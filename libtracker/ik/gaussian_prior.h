#pragma once
#include <Eigen/Core>
#include <vector>

#include "libtracker/ik/pose_prior.h"

namespace depthmocap {

// Poses about a mean: covariance basis diag(deviation^2) basis^T + residual_rad^2 (I - basis basis^T), a Gaussian of
// probabilistic PCA (Tipping and Bishop 1999).
struct PoseGaussian {
  double weight = 1;                                            // of the component in a mixture; they sum to 1
  PoseShape mean = PoseShape::Zero();                           // [rad]
  Eigen::Matrix<double, kShapeDofCount, Eigen::Dynamic> basis;  // orthonormal columns
  Eigen::VectorXd deviation;                                    // [rad] (> 0) along each column
  double residual_rad = 0.05;                                   // [rad] (> 0) in the other directions
};

// The Mahalanobis distance from the Gaussian that a pose most probably comes from: one Gaussian is probabilistic PCA,
// several are the mixture of GMM-IK (Wei and Chai 2009) with the nearest component for the sum (max-mixture, Olson and
// Agarwal 2013), so that |r|^2 is -2 log(weight N(shape)) of that component, up to a constant. The last row carries
// what differs among components besides the distance.
class GaussianPrior final : public PosePrior {
 public:
  explicit GaussianPrior(const std::vector<PoseGaussian>& components);  // at least one

  [[nodiscard]] int rows() const override { return kShapeDofCount + 1; }
  void evaluate(const PoseShape& shape, Eigen::Ref<Eigen::VectorXd> r, Eigen::MatrixXd* J) const override;

 private:
  using ShapeMatrix = Eigen::Matrix<double, kShapeDofCount, kShapeDofCount>;
  struct Component {
    PoseShape mean;
    ShapeMatrix whitening;  // of the covariance
    double constant = 0;    // the last row
  };
  std::vector<Component> components_;
};

}  // namespace depthmocap

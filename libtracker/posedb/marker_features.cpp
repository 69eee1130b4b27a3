#include "libtracker/posedb/marker_features.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "libtracker/core/check.h"
#include "libtracker/posedb/best_rotation.h"

namespace depthmocap {
namespace {

constexpr double kNoise_m = 0.03;           // [m] standard deviation of a seen marker's coordinate
constexpr double kStraySigma_m = 0.08;      // [m] of the reweighting: wider than the noise, tighter than a wrong limb
constexpr double kLeastVariance_m2 = 1e-6;  // [m^2] of a component, so that a constant one stays regular
constexpr double kFreePrecision = 1e-6;     // [1/m^2] of the translation: as good as free, yet regular without markers
constexpr int kRounds = 5;                  // of fitting z, then R and the weights

}  // namespace

MarkerFeatureSpace::MarkerFeatureSpace(const MarkerTable& table, int count, bool upright)
    : count_(count), upright_(upright) {
  DMC_CHECK(table.size() > 0 && count >= 1 && count <= kMaxMarkerFeatures);
  // The mean of the unturned markers is the first thing to turn shapes onto; their mean replaces it.
  for (std::size_t n = 0; n < table.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis)
      mean_.row(axis) += table.lane(n, axis).head<kPartCount>().cast<double>().matrix();
  }
  mean_ /= static_cast<double>(table.size());
  mean_.colwise() -= Eigen::Vector3d(mean_.rowwise().mean());
  learn(table);
}

void MarkerFeatureSpace::learn(const MarkerTable& table) {
  Eigen::MatrixXd moment = Eigen::MatrixXd::Zero(3 * kPartCount, 3 * kPartCount);
  Shape mean = Shape::Zero();
  for (std::size_t n = 0; n < table.size(); ++n) {
    const Shape shape = alignedShape(table, n);
    mean += shape;
    moment.selfadjointView<Eigen::Lower>().rankUpdate(shape.reshaped());
  }
  const auto poses = static_cast<double>(table.size());
  mean /= poses;
  moment /= poses;
  moment.selfadjointView<Eigen::Lower>().rankUpdate(mean.reshaped(), -1.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(moment);
  components_ = solver.eigenvectors().rightCols(count_).rowwise().reverse();
  variance_ = solver.eigenvalues().tail(count_).reverse().cwiseMax(kLeastVariance_m2);
  const Coordinates explained = components_.array().square().matrix() * variance_;
  noise_variance_ = (moment.diagonal() - explained).cwiseMax(0.0).array() + kNoise_m * kNoise_m;
  mean_ = mean;
}

Eigen::Matrix3d MarkerFeatureSpace::rotationOnto(const Shape& target, const Shape& markers,
                                                 const PartWeights& weights) const {
  const double total = weights.sum();
  if (total <= 0) return Eigen::Matrix3d::Identity();
  const Shape centred = markers.colwise() - Eigen::Vector3d(markers * weights / total);
  const Eigen::Matrix3d S = target * weights.asDiagonal() * centred.transpose();
  return upright_ ? bestRotationAboutY(S) : bestRotation(S);
}

MarkerFeatureSpace::Shape MarkerFeatureSpace::alignedShape(const MarkerTable& table, std::size_t n) const {
  Shape shape;
  for (int axis = 0; axis < 3; ++axis) shape.row(axis) = table.lane(n, axis).head<kPartCount>().cast<double>().matrix();
  shape.colwise() -= Eigen::Vector3d(shape.rowwise().mean());
  return rotationOnto(mean_, shape, PartWeights::Ones()) * shape;
}

MarkerFeatures MarkerFeatureSpace::project(const MarkerTable& table, std::size_t n) const {
  const Shape offset = alignedShape(table, n) - mean_;
  return (components_.transpose() * offset.reshaped()).cast<float>();
}

Eigen::Matrix3d MarkerFeatureSpace::roughRotation(const MarkerSet& markers) const {
  const PartWeights weights = markers.confidence.cwiseMax(0.0);
  return rotationOnto(mean_, (weights.array() > 0).transpose().replicate<3, 1>().select(markers.position, 0.0),
                      weights);
}

// The posterior mean of z and t for turned markers, by weighted least squares; returns mean + W z + t.
MarkerFeatureSpace::Shape MarkerFeatureSpace::fitted(const Shape& markers, const PartWeights& weights,
                                                     MarkerFeatures& z) const {
  constexpr int kMaxUnknowns = kMaxMarkerFeatures + 3;
  using System = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxUnknowns, kMaxUnknowns>;
  using Unknowns = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxUnknowns, 1>;
  const int size = count_ + 3;  // z, then t
  System normal = System::Zero(size, size);
  Unknowns right = Unknowns::Zero(size);
  Unknowns row = Unknowns::Zero(size);
  normal.diagonal().head(count_) = variance_.cwiseInverse();
  normal.diagonal().tail<3>().setConstant(kFreePrecision);
  for (int i = 0; i < kPartCount; ++i) {
    if (weights[i] <= 0) continue;
    for (int axis = 0; axis < 3; ++axis) {
      const int at = 3 * i + axis;
      const double weight = weights[i] / noise_variance_[at];
      row.head(count_) = components_.row(at).transpose();
      row.tail<3>() = Eigen::Vector3d::Unit(axis);
      normal.triangularView<Eigen::Lower>() += (weight * row).lazyProduct(row.transpose());
      right += weight * (markers(axis, i) - mean_(axis, i)) * row;
    }
  }
  const Unknowns unknowns = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
  z = unknowns.head(count_).cast<float>();
  const Coordinates shape = mean_.reshaped() + components_ * unknowns.head(count_);
  return shape.reshaped<Eigen::AutoOrder>(3, +kPartCount).colwise() + Eigen::Vector3d(unknowns.tail<3>());
}

void MarkerFeatureSpace::estimate(const MarkerSet& markers, const Eigen::Matrix3d& R_start, Estimate& result) const {
  constexpr double kPerStray = 1.0 / (2.0 * kStraySigma_m * kStraySigma_m);
  const PartWeights confidence = markers.confidence.cwiseMax(0.0);
  Shape seen = (confidence.array() > 0).transpose().replicate<3, 1>().select(markers.position, 0.0);
  if (confidence.sum() > 0) seen.colwise() -= Eigen::Vector3d(seen * confidence / confidence.sum());
  PartWeights weights = confidence;
  PartWeights misfit;  // squared, in units of 2 kStraySigma_m^2
  result.R = R_start;
  for (int round = 0; round < kRounds; ++round) {
    const Shape turned = result.R * seen;
    const Shape model = fitted(turned, weights, result.z);
    misfit = kPerStray * (model - turned).colwise().squaredNorm().transpose();
    weights = confidence.array() / (1.0 + misfit.array());
    result.R = rotationOnto(model, seen, weights);
  }
  const double stray_per_noise = (kStraySigma_m * kStraySigma_m) / (kNoise_m * kNoise_m);
  result.energy = stray_per_noise * confidence.dot(misfit.array().log1p().matrix()) +
                  0.5 * result.z.cast<double>().array().square().matrix().dot(variance_.cwiseInverse());
}

}  // namespace depthmocap

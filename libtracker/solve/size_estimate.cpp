#include "libtracker/solve/size_estimate.h"

namespace depthmocap {
namespace {

constexpr int kRounds = 5;                // of reweighting; the weights settle in about three
constexpr int kFewest = 4;                // markers
constexpr double kLeastSpread_m2 = 1e-3;  // [m^2] below this the markers lie in one place

using Points = Eigen::Matrix<double, 3, kPartCount>;
using Weights = Eigen::Matrix<double, kPartCount, 1>;

}  // namespace

SizeEstimate estimateSize(const ForwardKinematics& fk, const MarkerModel& model, const MarkerSet& markers_world,
                          double sigma_m) {
  SizeEstimate estimate;
  if (markers_world.seenCount() < kFewest) return estimate;
  Points model_points;
  for (int i = 0; i < kPartCount; ++i) model_points.col(i) = fk.position(model[static_cast<std::size_t>(i)]);
  const Weights confidence = markers_world.confidence.cwiseMax(0.0);
  Weights weight = confidence;
  for (int round = 0; round < kRounds; ++round) {
    const double total = weight.sum();
    const Points a = model_points.colwise() - Eigen::Vector3d(model_points * weight / total);
    const Points b = markers_world.position.colwise() - Eigen::Vector3d(markers_world.position * weight / total);
    estimate.spread_m2 = a.colwise().squaredNorm() * weight;
    if (estimate.spread_m2 < kLeastSpread_m2) return {};
    estimate.scale = a.cwiseProduct(b).colwise().sum() * weight;
    estimate.scale /= estimate.spread_m2;
    const Weights e2 = (b - estimate.scale * a).colwise().squaredNorm().transpose();
    weight = confidence.array() / (1.0 + e2.array() / (2.0 * sigma_m * sigma_m));
  }
  estimate.valid = estimate.scale > 0;
  return estimate.valid ? estimate : SizeEstimate{};
}

}  // namespace depthmocap

#include "libtracker/markers/mean_shift.h"

namespace depthmocap {

namespace {

// [m] An ascent ends at a shorter step. Chosen by hand (docs/tuning.md): below a hundredth of
// the bandwidth.
constexpr float kConvergedStep_m = 0.0005F;

Eigen::Map<const Eigen::ArrayXf> view(const std::vector<float>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

float MeanShift::density(const PartVotes& votes, const Eigen::Vector3f& at, float bandwidth_m, Eigen::Vector3f* mean) {
  if (kernel_.size() < votes.size()) kernel_.resize(votes.size());
  Eigen::Map<Eigen::ArrayXf> k(kernel_.data(), static_cast<Eigen::Index>(votes.size()));
  const float scale = 1.0F / (32.0F * bandwidth_m * bandwidth_m);
  const auto x = view(votes.x);
  const auto y = view(votes.y);
  const auto z = view(votes.z);
  k = (1.0F - ((x - at.x()).square() + (y - at.y()).square() + (z - at.z()).square()) * scale).max(0.0F);
  k = k.square().square().square().square().square() * view(votes.weight);
  const float sum = k.sum();
  if (mean != nullptr && sum > 0) *mean = Eigen::Vector3f((k * x).sum(), (k * y).sum(), (k * z).sum()) / sum;
  return sum;
}

float MeanShift::climb(const PartVotes& votes, float bandwidth_m, int max_iterations, Eigen::Vector3f& point) {
  for (int i = 0; i < max_iterations; ++i) {
    Eigen::Vector3f next = point;
    const float here = density(votes, point, bandwidth_m, &next);
    if (!(here > 0)) return 0;
    const float step = (next - point).norm();
    point = next;
    if (step < kConvergedStep_m) break;
  }
  return density(votes, point, bandwidth_m);
}

}  // namespace depthmocap

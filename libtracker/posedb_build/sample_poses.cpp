#include <algorithm>
#include <cmath>

#include "libtracker/core/random.h"
#include "libtracker/posedb_build/pose_mixture.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

constexpr double kMaxDeviations = 2.0;

double truncatedNormal(Random& random) {
  double value = random.normal();
  while (std::abs(value) > kMaxDeviations) value = random.normal();
  return value;
}

}  // namespace

std::vector<Eigen::Matrix<float, kDofCount, 1>> samplePoses(const PoseMixture& mixture, std::size_t count,
                                                            std::uint64_t seed) {
  std::vector<double> cumulative;
  double total = 0;
  for (const auto& component : mixture.components) cumulative.push_back(total += std::sqrt(component.weight));

  Random random(seed);
  std::vector<Eigen::Matrix<float, kDofCount, 1>> poses;
  poses.reserve(count);
  for (std::size_t i = 0; i < count && !cumulative.empty(); ++i) {
    const auto at = std::lower_bound(cumulative.begin(), cumulative.end() - 1, random.uniform() * total);
    const auto& component = mixture.components[static_cast<std::size_t>(at - cumulative.begin())];
    Eigen::Matrix<float, PoseMixture::kDims, 1> phi;
    for (int k = 0; k < PoseMixture::kDims; ++k) {
      phi[k] = static_cast<float>(truncatedNormal(random)) * component.deviation[k];
    }
    const Pose q = (component.mean + component.basis * phi).cast<double>();
    poses.push_back(clampedToLimits(q).cast<float>());
  }
  return poses;
}

}  // namespace depthmocap

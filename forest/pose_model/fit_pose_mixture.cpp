#include "forest/pose_model/fit_pose_mixture.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "depthmocap/error.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/core/parallel.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/local_prior.h"

namespace depthmocap {
namespace {

using PoseF = Eigen::Matrix<float, kDofCount, 1>;
using Poses = std::vector<PoseF>;

// Index of the nearest centre for each pose.
std::vector<std::size_t> assign(const Poses& poses, const Poses& centres, int threads) {
  std::vector<std::size_t> owner(poses.size());
  constexpr std::size_t kChunk = 1024;
  parallelFor(threads, (poses.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    for (std::size_t i = chunk * kChunk; i < std::min(poses.size(), (chunk + 1) * kChunk); ++i) {
      float best = std::numeric_limits<float>::max();
      for (std::size_t c = 0; c < centres.size(); ++c) {
        const float d = (poses[i] - centres[c]).squaredNorm();
        if (d < best) {
          best = d;
          owner[i] = c;
        }
      }
    }
  });
  return owner;
}

// k-means++ (Arthur and Vassilvitskii 2007).
Poses firstCentres(const Poses& poses, int count, Random& random) {
  Poses centres{poses[random.below(static_cast<std::uint32_t>(poses.size()))]};
  std::vector<double> distance(poses.size(), std::numeric_limits<double>::max());
  while (static_cast<int>(centres.size()) < count) {
    double total = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      distance[i] = std::min(distance[i], static_cast<double>((poses[i] - centres.back()).squaredNorm()));
      total += distance[i];
    }
    if (total <= 0) break;
    double pick = random.uniform() * total;
    std::size_t i = 0;
    while (i + 1 < poses.size() && (pick -= distance[i]) > 0) ++i;
    centres.push_back(poses[i]);
  }
  return centres;
}

Poses means(const Poses& poses, const std::vector<std::size_t>& owner, std::size_t count, std::vector<int>& sizes) {
  std::vector<Pose> sums(count, Pose::Zero());
  sizes.assign(count, 0);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    sums[owner[i]] += poses[i].cast<double>();
    ++sizes[owner[i]];
  }
  Poses result(count);
  for (std::size_t c = 0; c < count; ++c) result[c] = (sums[c] / std::max(1, sizes[c])).cast<float>();
  return result;
}

// Takes the smaller half of the clusters that are too small off the list; false if none is.
bool dissolveSmall(Poses& centres, const std::vector<int>& sizes, int min_size) {
  std::vector<int> small;
  std::copy_if(sizes.begin(), sizes.end(), std::back_inserter(small), [&](int size) { return size < min_size; });
  if (small.empty()) return false;
  const auto middle = small.begin() + static_cast<std::ptrdiff_t>((small.size() - 1) / 2);
  std::nth_element(small.begin(), middle, small.end());
  Poses kept;
  for (std::size_t c = 0; c < centres.size(); ++c) {
    if (sizes[c] > *middle) kept.push_back(centres[c]);
  }
  // All of one size, and too small: any one of them takes the rest.
  if (kept.empty()) kept.push_back(centres.front());
  centres = std::move(kept);
  return true;
}

PoseMixture::Component fitComponent(const Poses& poses, const std::vector<std::size_t>& owner, std::size_t cluster,
                                    const PoseF& mean) {
  Eigen::Matrix<double, kDofCount, kDofCount> covariance = Eigen::Matrix<double, kDofCount, kDofCount>::Zero();
  int count = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (owner[i] != cluster) continue;
    const Pose d = (poses[i] - mean).cast<double>();
    covariance += d * d.transpose();
    ++count;
  }
  covariance /= std::max(1, count - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, kDofCount, kDofCount>> solver(covariance);
  PoseMixture::Component component;
  component.weight = static_cast<float>(count) / static_cast<float>(poses.size());
  component.mean = mean;
  for (int k = 0; k < PoseMixture::kDims; ++k) {
    const int column = kDofCount - 1 - k;  // eigenvalues ascend
    component.basis.col(k) = solver.eigenvectors().col(column).cast<float>();
    component.deviation[k] = static_cast<float>(std::sqrt(std::max(0.0, solver.eigenvalues()[column])));
  }
  const double others = solver.eigenvalues().head(kDofCount - PoseMixture::kDims).cwiseMax(0).sum();
  component.residual = static_cast<float>(std::sqrt(others / (kShapeDofCount - PoseMixture::kDims)));
  return component;
}

}  // namespace

void PoseMixtureConfig::validate() const {
  const char* name = "PoseMixtureConfig";
  checkConfig(components >= 1, name, "components", components, "at least 1");
  checkConfig(min_poses > PoseMixture::kDims, name, "min_poses", min_poses, "above 10");
  checkConfig(iterations >= 1, name, "iterations", iterations, "at least 1");
  checkConfig(threads >= 1, name, "threads", threads, "at least 1");
}

PoseMixture fitPoseMixture(const PoseDatabase& database, const PoseMixtureConfig& config) {
  config.validate();
  const Poses& poses = database.poses;
  if (poses.size() < static_cast<std::size_t>(config.min_poses)) {
    throw Error("too few poses for a pose mixture", "pose database", "give more motions");
  }
  Random random(config.seed);
  Poses centres = firstCentres(poses, config.components, random);
  std::vector<std::size_t> owner;
  std::vector<int> sizes;
  for (int iteration = 0; iteration < config.iterations; ++iteration) {
    owner = assign(poses, centres, config.threads);
    centres = means(poses, owner, centres.size(), sizes);
  }
  while (dissolveSmall(centres, sizes, config.min_poses)) {
    owner = assign(poses, centres, config.threads);
    centres = means(poses, owner, centres.size(), sizes);
  }

  PoseMixture mixture;
  mixture.components.resize(centres.size());
  parallelFor(config.threads, centres.size(),
              [&](std::size_t c) { mixture.components[c] = fitComponent(poses, owner, c, centres[c]); });
  return mixture;
}

}  // namespace depthmocap

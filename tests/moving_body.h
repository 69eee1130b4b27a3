#pragma once
#include <Eigen/SVD>
#include <cmath>
#include <vector>

#include "depthmocap/marker_set.h"
#include "libtracker/core/random.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"
#include "libtracker/skeleton/local_prior.h"
#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {

// A body, and smooth made-up motions of it, for the tests of search, prior and solve.
struct MovingBody {
  Skeleton skeleton = makeSkeleton(BoneLengths{});
  MarkerModel model = averageMarkerModel(skeleton);

  // A swinging and turning body at time t [s]; a few sine waves drive all DoFs, so its poses lie near a low-dimensional
  // subspace, as those of a real motion do. `seed` chooses the motion.
  [[nodiscard]] static Pose motion(std::uint64_t seed, double t) {
    Random random(seed);
    const JointLimits& limits = jointLimits();
    Eigen::Vector3d wave;
    for (int k = 0; k < 3; ++k) wave[k] = std::sin(2.0 * (k + 1) * t + random.uniform(0, 6.28));
    Pose q;
    for (int i = 0; i < kDofCount; ++i) {
      const Eigen::Vector3d mix(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const double range = i < kFirstBodyDof ? 0.3 : 0.3 * (limits.upper[i] - limits.lower[i]) / 2.0;
      const double centre = i < kFirstBodyDof ? 0.0 : 0.5 * (limits.upper[i] + limits.lower[i]) * 0.6;
      q[i] = centre + range * mix.dot(wave) / 2.0;
    }
    q[kRootTz] -= 2.5;
    return q;
  }

  [[nodiscard]] MarkerSet markers(const Pose& q) const {
    ForwardKinematics fk;
    fk.update(skeleton, q);
    MarkerSet set;
    for (int i = 0; i < kPartCount; ++i) set.position.col(i) = fk.position(model[static_cast<std::size_t>(i)]);
    set.confidence.setOnes();
    return set;
  }

  // Normal noise [m] on each coordinate; `missing` of the markers, chosen at random, are not seen.
  [[nodiscard]] MarkerSet noisyMarkers(const Pose& q, double noise_m, int missing, Random& random) const {
    MarkerSet set = markers(q);
    for (int i = 0; i < kPartCount; ++i) {
      for (int k = 0; k < 3; ++k) set.position(k, i) += noise_m * random.normal();
    }
    for (int i = 0; i < missing; ++i) set.confidence[random.below(kPartCount)] = 0;
    return set;
  }

  // PCA over the poses, over kShapeDofs.
  [[nodiscard]] static LocalPrior priorOf(const std::vector<Pose>& poses, int dims) {
    Eigen::MatrixXd shapes(kDofCount, static_cast<Eigen::Index>(poses.size()));
    for (std::size_t i = 0; i < poses.size(); ++i) {
      shapes.col(static_cast<Eigen::Index>(i)) = poses[i];
      for (int dof : {+kRootTx, +kRootTy, +kRootTz, +kRootRy}) shapes(dof, static_cast<Eigen::Index>(i)) = 0;
    }
    LocalPrior prior;
    prior.mean = shapes.rowwise().mean();
    shapes.colwise() -= prior.mean;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(shapes, Eigen::ComputeThinU);
    prior.basis.leftCols(dims) = svd.matrixU().leftCols(dims);
    prior.dims = dims;
    prior.neighbours = static_cast<int>(poses.size());
    return prior;
  }

  // Mean distance of the 18 joints [m].
  [[nodiscard]] double jointError(const Pose& a, const Pose& b) const {
    return (jointPositions(skeleton, a) - jointPositions(skeleton, b)).colwise().norm().mean();
  }
};

}  // namespace depthmocap

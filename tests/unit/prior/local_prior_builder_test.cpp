#include "libtracker/prior/local_prior_builder.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <cmath>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/skeleton/skeleton.h"
#include "tests/moving_body.h"

namespace depthmocap {
namespace {

PoseDatabase databaseOf(const std::vector<Pose>& poses) {
  PoseDatabase database;
  for (Pose q : poses) {
    q.head<3>().setZero();
    q[kRootRy] = 0;
    database.poses.push_back(q.cast<float>());
  }
  return database;
}

std::vector<PoseNeighbour> firstNeighbours(std::size_t count) {
  std::vector<PoseNeighbour> neighbours;
  for (std::size_t i = 0; i < count; ++i)
    neighbours.push_back({static_cast<std::uint32_t>(i), 0.1 * static_cast<double>(i)});
  return neighbours;
}

// `count` poses of a motion, nearest to its middle first, with noise [rad] on each DoF.
std::vector<Pose> noisyPoses(std::uint64_t seed, int count, double noise) {
  Random random(seed);
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    Pose q = MovingBody::motion(seed, 0.02 * (i % 2 == 0 ? i : -i));
    for (int dof : kShapeDofs) q[dof] += noise * random.normal();
    poses.push_back(q);
  }
  return poses;
}

// Poses in an affine subspace of `dims` dimensions, plus noise [rad]; the spread falls from dimension to dimension.
std::vector<Pose> posesOfDims(int dims, double noise, int count, Random& random) {
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(kDofCount, dims);
  for (int b = 0; b < dims; ++b) {
    for (int dof : kShapeDofs) directions(dof, b) = random.normal() / std::sqrt(kShapeDofCount);
  }
  std::vector<Pose> poses;
  for (int i = 0; i < count; ++i) {
    Pose q = Pose::Zero();
    for (int b = 0; b < dims; ++b) q += directions.col(b) * random.normal() * (1.0 - 0.05 * b);
    for (int dof : kShapeDofs) q[dof] += noise * random.normal();
    poses.push_back(q);
  }
  return poses;
}

// The criterion as documented, step by step: leave the pose out, PCA by SVD, hide each bone, fit phi to the rest.
double plainError(const PoseDatabase& database, int neighbours, int dims, int held_out) {
  double error = 0;
  for (int left_out = 0; left_out < held_out; ++left_out) {
    Eigen::MatrixXd others(kDofCount, neighbours - 1);
    for (int k = 0, column = 0; k < neighbours; ++k) {
      if (k != left_out) others.col(column++) = database.pose(static_cast<std::size_t>(k));
    }
    const Pose mean = others.rowwise().mean();
    others.colwise() -= mean;
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(others, Eigen::ComputeThinU);
    const Eigen::MatrixXd P = svd.matrixU().leftCols(dims);
    const Pose d = database.pose(static_cast<std::size_t>(left_out)) - mean;
    for (const BoneDofs& bone : kBoneDofs) {
      Eigen::MatrixXd seen = P;
      Pose seen_d = d;
      seen.middleRows(bone.first, bone.count).setZero();
      seen_d.segment(bone.first, bone.count).setZero();
      const Eigen::VectorXd phi = seen.colPivHouseholderQr().solve(seen_d);
      error += (d - P * phi).segment(bone.first, bone.count).squaredNorm();
    }
  }
  return error;
}

TEST(LocalPriorBuilder, ErrorsAreThoseOfThePlainCrossValidation) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const PoseDatabase database = databaseOf(noisyPoses(seed, 50, 0.03));
    const PriorConfig config;
    LocalPriorBuilder builder(config);
    LocalPrior prior;
    builder.build(database, firstNeighbours(50), prior);
    for (std::size_t i = 0; i < config.neighbours.size(); ++i) {
      for (std::size_t j = 0; j < config.dims.size(); ++j) {
        const double plain = plainError(database, config.neighbours[i], config.dims[j], config.held_out);
        EXPECT_NEAR(builder.modelError(i, j), plain, 1e-6 * plain)
            << "K " << config.neighbours[i] << " B " << config.dims[j];
      }
    }
  }
}

TEST(LocalPriorBuilder, TakesTheModelOfLeastError) {
  const PoseDatabase database = databaseOf(noisyPoses(4, 50, 0.05));
  const PriorConfig config;
  LocalPriorBuilder builder(config);
  LocalPrior prior;
  builder.build(database, firstNeighbours(50), prior);
  for (std::size_t i = 0; i < config.neighbours.size(); ++i) {
    for (std::size_t j = 0; j < config.dims.size(); ++j) {
      if (config.neighbours[i] != prior.neighbours || config.dims[j] != prior.dims) continue;
      for (std::size_t k = 0; k < config.neighbours.size(); ++k) {
        for (std::size_t l = 0; l < config.dims.size(); ++l)
          EXPECT_LE(builder.modelError(i, j), builder.modelError(k, l));
      }
      return;
    }
  }
  FAIL() << "the model is none of the configuration's: K " << prior.neighbours << " B " << prior.dims;
}

// The criterion must not always want more dimensions: it finds those that the poses have.
TEST(LocalPriorBuilder, FindsTheDimensionsOfThePoses) {
  PriorConfig config;
  config.neighbours = {50};
  config.dims = {1, 2, 3, 4, 5, 6, 7};
  LocalPriorBuilder builder(config);
  LocalPrior prior;
  Random random(11);
  for (const int dims : {2, 3, 5}) {
    int exact = 0;
    for (int repeat = 0; repeat < 10; ++repeat) {
      builder.build(databaseOf(posesOfDims(dims, 0.03, 50, random)), firstNeighbours(50), prior);
      exact += static_cast<int>(prior.dims == dims);
    }
    EXPECT_GE(exact, 8) << "of 10 with " << dims << " dimensions";
  }
}

TEST(LocalPriorBuilder, BasisIsOrthonormalSpansThePosesAndLeavesPlaceAndHeadingOut) {
  Random random(12);
  const std::vector<Pose> poses = posesOfDims(3, 1e-4, 30, random);
  PriorConfig config;
  config.neighbours = {30};
  config.dims = {3};
  LocalPriorBuilder builder(config);
  LocalPrior prior;
  builder.build(databaseOf(poses), firstNeighbours(30), prior);
  ASSERT_EQ(prior.dims, 3);
  const auto P = prior.basis.leftCols<3>();
  EXPECT_LT((P.transpose() * P - Eigen::Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_EQ(prior.residual_rad, 0);
  EXPECT_EQ(prior.basis.rightCols<kMaxPriorDims - 3>().norm(), 0);
  for (int dof : {+kRootTx, +kRootTy, +kRootTz, +kRootRy}) {
    EXPECT_EQ(prior.mean[dof], 0);
    EXPECT_EQ(P.row(dof).norm(), 0);
  }
  double spread = 0;
  for (const Pose& q : poses) {
    const Pose d = q - prior.mean;
    EXPECT_LT((d - P * (P.transpose() * d)).norm(), 2e-3);
    spread += (P.transpose() * d).squaredNorm() / 30;
  }
  EXPECT_NEAR(prior.deviation.squaredNorm(), spread, 1e-6);
  EXPECT_GE(prior.deviation[0], prior.deviation[1]);
}

TEST(LocalPriorBuilder, AGaussianHoldsTheCovarianceOfAllNeighbours) {
  Random random(15);
  const std::vector<Pose> poses = posesOfDims(10, 0.02, 40, random);
  PriorConfig config;
  config.neighbours = {15, 45};
  config.residual_rad = 0.05;
  LocalPriorBuilder builder(config);
  LocalPrior prior;
  builder.build(databaseOf(poses), firstNeighbours(40), prior);
  EXPECT_EQ(prior.neighbours, 40);
  EXPECT_EQ(prior.residual_rad, 0.05);
  using Covariance = Eigen::Matrix<double, kDofCount, kDofCount>;
  Covariance expected = Covariance::Zero();
  for (const Pose& q : poses) expected += (q - prior.mean) * (q - prior.mean).transpose() / 40;
  const auto P = prior.basis.leftCols(prior.dims);
  const Covariance held = P * prior.deviation.head(prior.dims).cwiseAbs2().asDiagonal() * P.transpose();
  EXPECT_LT((held - expected).norm(), 1e-5 * expected.norm());
}

TEST(LocalPriorBuilder, UsesOnlyTheNearestOfTheChosenK) {
  Random random(13);
  std::vector<Pose> poses = posesOfDims(3, 0.01, 50, random);
  for (std::size_t i = 15; i < poses.size(); ++i) {
    for (int dof : kShapeDofs) poses[i][dof] += random.normal();
  }
  LocalPriorBuilder builder{PriorConfig{}};
  LocalPrior prior;
  builder.build(databaseOf(poses), firstNeighbours(50), prior);
  EXPECT_EQ(prior.neighbours, 15);
}

TEST(LocalPriorBuilder, BearsFewNeighboursAndEqualPoses) {
  Random random(14);
  const PoseDatabase database = databaseOf(posesOfDims(6, 0.05, 20, random));
  LocalPriorBuilder builder{PriorConfig{}};
  LocalPrior prior;
  builder.build(database, firstNeighbours(20), prior);
  EXPECT_EQ(prior.neighbours, 15);
  builder.build(database, firstNeighbours(6), prior);
  EXPECT_EQ(prior.neighbours, 6);
  EXPECT_EQ(prior.dims, 3);
  builder.build(database, firstNeighbours(2), prior);
  EXPECT_LE(prior.dims, 1);
  builder.build(database, firstNeighbours(1), prior);
  EXPECT_EQ(prior.dims, 0);
  EXPECT_LT((prior.mean - database.pose(0)).norm(), 1e-6);
  const PoseDatabase equal = databaseOf(std::vector<Pose>(50, database.pose(3)));
  builder.build(equal, firstNeighbours(50), prior);
  EXPECT_EQ(prior.dims, 0);
  EXPECT_TRUE(prior.mean.allFinite());
}

TEST(LocalPriorBuilder, RepeatedBuildsGiveTheSameBytes) {
  const PoseDatabase a = databaseOf(noisyPoses(6, 50, 0.03));
  const PoseDatabase b = databaseOf(noisyPoses(7, 50, 0.03));
  LocalPriorBuilder builder{PriorConfig{}};
  LocalPrior first;
  LocalPrior other;
  LocalPrior second;
  builder.build(a, firstNeighbours(50), first);
  builder.build(b, firstNeighbours(12), other);
  builder.build(a, firstNeighbours(50), second);
  EXPECT_EQ(first.mean, second.mean);
  EXPECT_EQ(first.basis, second.basis);
}

TEST(PriorConfig, RefusesListsOutOfRangeOrOrder) {
  const auto with = [](std::vector<int> neighbours, std::vector<int> dims, int held_out) {
    PriorConfig config;
    config.neighbours = std::move(neighbours);
    config.dims = std::move(dims);
    config.held_out = held_out;
    return config;
  };
  EXPECT_NO_THROW(with({15, 50}, {1, 7}, 8).validate());
  EXPECT_THROW(with({}, {3}, 8).validate(), Error);
  EXPECT_THROW(with({15, 51}, {3}, 8).validate(), Error);
  EXPECT_THROW(with({30, 15}, {3}, 8).validate(), Error);
  EXPECT_THROW(with({15}, {3, 3}, 8).validate(), Error);
  EXPECT_THROW(with({15}, {33}, 8).validate(), Error);
  EXPECT_THROW(with({15}, {3}, 16).validate(), Error);
  EXPECT_THROW(with({15}, {3}, 0).validate(), Error);
  PriorConfig negative;
  negative.residual_rad = -0.1;
  EXPECT_THROW(negative.validate(), Error);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/posedb/pose_search.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "tests/moving_body.h"

namespace depthmocap {
namespace {

constexpr int kMotions = 12;
constexpr int kPosesPerMotion = 250;

// Poses of several made-up motions without place and heading, as a database holds them.
PoseDatabase madeUpDatabase() {
  PoseDatabase database;
  for (int motion = 0; motion < kMotions; ++motion) {
    for (int i = 0; i < kPosesPerMotion; ++i) {
      Pose q = MovingBody::motion(static_cast<std::uint64_t>(motion + 1), 0.02 * i);
      q.head<3>().setZero();
      q[kRootRy] = 0;
      database.poses.push_back(q.cast<float>());
    }
  }
  return database;
}

struct Scene {
  MovingBody body;
  PoseDatabase database = madeUpDatabase();

  PoseSearch search(const PoseSearchConfig& config = {}) const { return {database, body.skeleton, body.model, config}; }
  // A query for a pose between those of the database, turned and moved; markers with noise.
  [[nodiscard]] PoseQuery query(std::uint64_t motion, double t, double heading, double noise_m, int missing,
                                Random& random) const {
    PoseQuery result;
    const auto placed = [&](double time) {
      Pose q = MovingBody::motion(motion, time);
      q[kRootRy] = heading;
      return q;
    };
    result.markers = body.noisyMarkers(placed(t), noise_m, missing, random);
    result.q_prev = placed(t - 0.033);
    result.q_prev2 = placed(t - 0.067);
    result.heading = heading;
    return result;
  }
};

// Equation (3) written out, with the rotation by singular values.
double plainDistance(const Scene& scene, const PoseQuery& query, std::uint32_t n, const PoseSearchConfig& config) {
  const Pose pose = scene.database.pose(n);
  const MarkerSet a = scene.body.markers(pose);
  const Eigen::Matrix<double, kPartCount, 1>& c = query.markers.confidence;
  const Eigen::Vector3d a_mean = a.position * c / c.sum();
  const Eigen::Vector3d b_mean = query.markers.position * c / c.sum();
  const Eigen::Matrix<double, 3, kPartCount> x = a.position.colwise() - a_mean;
  const Eigen::Matrix<double, 3, kPartCount> y = (query.markers.position.colwise() - b_mean) / query.scale;
  const Eigen::Matrix3d S = x * c.asDiagonal() * y.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(S, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d D = Eigen::Matrix3d::Identity();
  D(2, 2) = svd.matrixU().determinant() * svd.matrixV().determinant();
  const Eigen::Matrix3d R = svd.matrixU() * D * svd.matrixV().transpose();
  double distance = 0;
  for (int i = 0; i < kPartCount; ++i) {
    const double e2 = (x.col(i) - R * y.col(i)).squaredNorm();
    distance += config.alpha * c[i] * std::log(1.0 + e2 / (2.0 * config.sigma_m * config.sigma_m));
  }
  if (!query.has_history) return distance;
  Pose change = pose - 2.0 * query.q_prev + query.q_prev2;
  for (int dof : {+kRootTx, +kRootTy, +kRootTz, +kRootRy}) change[dof] = 0;
  return distance + config.beta * change.squaredNorm();
}

TEST(PoseSearch, DistanceIsEquation3) {
  const Scene scene;
  const PoseSearchConfig config;
  PoseSearch search = scene.search(config);
  Random random(1);
  for (const bool has_history : {false, true}) {
    PoseQuery query = scene.query(3, 1.234, 0.8, 0.02, 4, random);
    query.has_history = has_history;
    query.markers.confidence[6] *= 0.4;
    query.scale = 1.07;
    std::vector<PoseNeighbour> all;
    search.searchExhaustive(query, static_cast<int>(scene.database.size()), all);
    ASSERT_EQ(all.size(), scene.database.size());
    for (std::size_t i = 0; i < all.size(); i += 97) {
      const double expected = plainDistance(scene, query, all[i].index, config);
      EXPECT_NEAR(all[i].distance, expected, 1e-4 * std::max(1.0, expected));
    }
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), [](auto& a, auto& b) { return a.distance < b.distance; }));
  }
}

TEST(PoseSearch, FindsADatabasePoseFromItsMarkersWhereverItStands) {
  const Scene scene;
  PoseSearch search = scene.search();
  std::vector<PoseNeighbour> neighbours;
  for (std::uint32_t n = 20; n < scene.database.size(); n += 333) {
    PoseQuery query;
    Pose q = scene.database.pose(n);
    q.head<3>() << 0.5, -0.3, -3.0;
    q[kRootRy] = 0.01 * n;
    query.markers = scene.body.markers(q);
    search.search(query, 5, neighbours);
    ASSERT_EQ(neighbours.size(), 5U);
    EXPECT_EQ(neighbours[0].index, n);
    EXPECT_LT(neighbours[0].distance, 1e-6);
  }
}

// Share of the exhaustive search's `count` nearest that the index finds too.
double recall(const Scene& scene, bool has_history, int missing, bool hide_axes) {
  constexpr int kCount = 30;
  constexpr int kQueries = 40;
  PoseSearchConfig config;
  config.candidates = 256;
  PoseSearch search = scene.search(config);
  Random random(7);
  std::vector<PoseNeighbour> found;
  std::vector<PoseNeighbour> truth;
  int hits = 0;
  for (int i = 0; i < kQueries; ++i) {
    PoseQuery query = scene.query(1 + random.below(kMotions), random.uniform(0.2, 4.5), random.uniform(-3, 3), 0.015,
                                  missing, random);
    query.has_history = has_history;
    query.heading += random.uniform(-0.2, 0.2);
    if (hide_axes) {
      for (Part part : {Part::LeftShoulder, Part::LeftWaist, Part::RightUpperLeg})
        query.markers.confidence[partIndex(part)] = 0;
    }
    search.search(query, kCount, found);
    search.searchExhaustive(query, kCount, truth);
    for (const PoseNeighbour& neighbour : truth) {
      hits += static_cast<int>(
          std::any_of(found.begin(), found.end(), [&](auto& f) { return f.index == neighbour.index; }));
    }
  }
  return static_cast<double>(hits) / (kCount * kQueries);
}

TEST(PoseSearch, IndexFindsWhatTheExhaustiveSearchFinds) {
  const Scene scene;
  EXPECT_GT(recall(scene, true, 0, false), 0.95);
  EXPECT_GT(recall(scene, false, 0, false), 0.95);
}

TEST(PoseSearch, RecallBearsMissingMarkersAndAnUnknownHeading) {
  const Scene scene;
  EXPECT_GT(recall(scene, true, 5, false), 0.9);
  EXPECT_GT(recall(scene, false, 5, false), 0.85);
  EXPECT_GT(recall(scene, false, 0, true), 0.8);
}

TEST(PoseSearch, UnseenMarkersMayHoldAnything) {
  const Scene scene;
  PoseSearch search = scene.search();
  Random random(2);
  PoseQuery query = scene.query(2, 1.0, 0.3, 0.01, 0, random);
  query.markers.confidence[3] = query.markers.confidence[8] = 0;
  std::vector<PoseNeighbour> expected;
  search.search(query, 10, expected);
  query.markers.position.col(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  query.markers.position.col(8).setConstant(1e9);
  std::vector<PoseNeighbour> found;
  search.search(query, 10, found);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].index, expected[i].index);
}

TEST(PoseSearch, ActorOfAnotherSizeIsScaledFirst) {
  const Scene scene;
  PoseSearch search = scene.search();
  MovingBody child;
  child.skeleton = makeSkeleton(scene.body.skeleton.lengths.scaled(0.7));
  child.model = averageMarkerModel(child.skeleton);
  PoseQuery query;
  query.markers = child.markers(scene.database.pose(777));
  query.scale = 0.7;
  std::vector<PoseNeighbour> found;
  search.search(query, 1, found);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].index, 777U);
  EXPECT_LT(found[0].distance, 1e-6);
}

TEST(PoseSearch, UprightAlignmentKeepsALyingBodyFromAStandingOne) {
  Scene scene;
  for (auto& pose : scene.database.poses) pose[kRootRx] = pose[kRootRz] = 0;
  Pose lying = scene.database.pose(500);
  lying[kRootRx] = -1.5;
  PoseQuery query;
  query.markers = scene.body.markers(lying);
  std::vector<PoseNeighbour> any;
  std::vector<PoseNeighbour> upright;
  scene.search().searchExhaustive(query, 1, any);
  PoseSearchConfig config;
  config.upright_alignment = true;
  scene.search(config).searchExhaustive(query, 1, upright);
  EXPECT_EQ(any[0].index, 500U);
  EXPECT_LT(any[0].distance, 1e-6);
  EXPECT_GT(upright[0].distance, 5.0);
}

TEST(PoseSearch, EqualPosesComeByIndexAndAskingForMoreGivesAll) {
  Scene scene;
  scene.database.poses.assign(8, scene.database.poses[100]);
  PoseQuery query;
  query.markers = scene.body.markers(scene.database.pose(0));
  std::vector<PoseNeighbour> found;
  scene.search().search(query, 50, found);
  ASSERT_EQ(found.size(), 8U);
  for (std::uint32_t i = 0; i < 8; ++i) EXPECT_EQ(found[i].index, i);
}

TEST(PoseSearch, TwoSearchesGiveTheSameBytes) {
  const Scene scene;
  PoseSearch a = scene.search();
  PoseSearch b = scene.search();
  Random random(5);
  std::vector<PoseNeighbour> from_a;
  std::vector<PoseNeighbour> from_b;
  for (int i = 0; i < 5; ++i) {
    PoseQuery query = scene.query(4, 0.5 + 0.3 * i, 2.0, 0.02, 3, random);
    query.has_history = i % 2 == 0;
    a.search(query, 50, from_a);
    b.search(query, 50, from_b);
    ASSERT_EQ(from_a.size(), from_b.size());
    for (std::size_t k = 0; k < from_a.size(); ++k) {
      EXPECT_EQ(from_a[k].index, from_b[k].index);
      EXPECT_EQ(from_a[k].distance, from_b[k].distance);
    }
  }
}

TEST(PoseSearch, WithoutMarkersTheHistoryDecides) {
  const Scene scene;
  PoseSearch search = scene.search();
  PoseQuery query;
  query.has_history = true;
  query.q_prev = query.q_prev2 = scene.database.pose(1234);
  std::vector<PoseNeighbour> found;
  search.searchExhaustive(query, 1, found);
  EXPECT_EQ(found[0].index, 1234U);
  query.has_history = false;
  search.search(query, 10, found);
  EXPECT_EQ(found.size(), 10U);
  EXPECT_EQ(found[0].distance, 0);
}

TEST(PoseSearch, RefusesAnEmptyDatabaseAndValuesOutOfRange) {
  Scene scene;
  PoseSearchConfig config;
  config.features = 31;
  EXPECT_THROW(scene.search(config), Error);
  config = {};
  config.sigma_m = 0;
  try {
    scene.search(config);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("sigma_m"), std::string::npos);
  }
  scene.database.poses.clear();
  EXPECT_THROW(scene.search(), Error);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/solve/map_solver.h"

#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "tests/moving_body.h"

namespace depthmocap {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;

std::vector<Pose> posesAround(std::uint64_t seed, double t) {
  std::vector<Pose> poses;
  for (int i = -12; i <= 12; ++i) poses.push_back(MovingBody::motion(seed, t + 0.02 * i + 0.007));
  return poses;
}

TEST(MapSolver, RecoversThePoseFromPerfectMarkers) {
  const MovingBody scene;
  MapSolver solver{MapConfig{}};
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Pose truth = MovingBody::motion(seed, 1.0);
    const MarkerSet markers = scene.markers(truth);
    const LocalPrior prior = MovingBody::priorOf(posesAround(seed, 1.0), 7);
    Pose q = MovingBody::motion(seed, 0.8);
    ASSERT_GT(scene.jointError(q, truth), 0.02);
    const MapSummary summary = solver.solve({scene.skeleton, scene.model, markers, &prior}, q);
    EXPECT_TRUE(summary.converged);
    EXPECT_LT(scene.jointError(q, truth), 0.01) << "seed " << seed;
    EXPECT_LT(summary.rms_marker_m, 0.005);
  }
}

TEST(MapSolver, EndsAfterTheStepsThatItIsGiven) {
  const MovingBody scene;
  MapSolver solver{MapConfig{}};
  const MarkerSet markers = scene.markers(MovingBody::motion(2, 1.0));
  Pose q = Pose::Zero();
  double energy = std::numeric_limits<double>::max();
  for (int i = 0; i < 3; ++i) {
    const MapSummary summary = solver.solve({scene.skeleton, scene.model, markers}, q, 1);
    EXPECT_FALSE(summary.converged);
    EXPECT_LT(summary.energy, energy) << "a step that raises the energy is tried again, shorter";
    energy = summary.energy;
  }
  EXPECT_LT(solver.solve({scene.skeleton, scene.model, markers}, q).energy, energy);
}

TEST(MapSolver, MeetsTheReferenceSolver) {
  const MovingBody scene;
  MapConfig config;
  config.energy_tolerance = 1e-12;
  config.max_iterations = 200;
  MapSolver solver(config);
  Random random(3);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const MarkerSet markers = scene.noisyMarkers(MovingBody::motion(seed, 1.0), 0.01, 3, random);
    const LocalPrior prior = MovingBody::priorOf(posesAround(seed, 1.0), 5);
    const Pose q1 = MovingBody::motion(seed, 1.0 - kFrame_s);
    const Pose q2 = MovingBody::motion(seed, 1.0 - 2 * kFrame_s);
    const MapInput input{scene.skeleton, scene.model, markers, &prior, &q1, &q2};
    Pose q = q1;
    Pose reference = q1;
    const MapSummary fast = solver.solve(input, q);
    const MapSummary slow = solver.solveReference(input, reference);
    ASSERT_TRUE(slow.converged);
    EXPECT_NEAR(fast.energy, slow.energy, 1e-7);
    EXPECT_LT((q - reference).norm(), 1e-3) << "seed " << seed;
  }
}

TEST(MapSolver, EnergyIsTheWeightedSumOfTheTerms) {
  const MovingBody scene;
  const MapConfig config;
  MapSolver solver(config);
  Random random(4);
  const MarkerSet markers = scene.noisyMarkers(MovingBody::motion(1, 1.0), 0.02, 2, random);
  const LocalPrior prior = MovingBody::priorOf(posesAround(1, 1.0), 3);
  const Pose q1 = MovingBody::motion(1, 0.95);
  Pose q = q1;
  const MapSummary s = solver.solve({scene.skeleton, scene.model, markers, &prior, &q1}, q);
  EXPECT_GT(s.e_marker, 0);
  EXPECT_GT(s.e_prior, 0);
  EXPECT_GT(s.e_smooth, 0);
  const double sum = config.lambda_marker * s.e_marker + config.lambda_prior * s.e_prior +
                     config.lambda_smooth * s.e_smooth + config.lambda_limit * s.e_limit;
  EXPECT_NEAR(s.energy, sum, 1e-12);
}

struct TrackError {
  double joint_m = 0;
  double iterations = 0;
};

// Tracks made-up motions from markers with 1 cm noise, `missing` of them not seen; mean joint error over their frames.
TrackError track(const MapConfig& config, bool with_prior, bool with_smooth, int missing) {
  const MovingBody scene;
  constexpr int kFrames = 40;
  TrackError error;
  MapSolver solver(config);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    Pose q1 = MovingBody::motion(seed, -kFrame_s);
    Pose q2 = MovingBody::motion(seed, -2 * kFrame_s);
    for (int frame = 0; frame < kFrames; ++frame) {
      const double t = frame * kFrame_s;
      const Pose truth = MovingBody::motion(seed, t);
      const MarkerSet markers = scene.noisyMarkers(truth, 0.01, missing, random);
      const LocalPrior prior = MovingBody::priorOf(posesAround(seed, t), 5);
      Pose q = q1;
      const MapInput input{scene.skeleton,
                           scene.model,
                           markers,
                           with_prior ? &prior : nullptr,
                           with_smooth ? &q1 : nullptr,
                           with_smooth ? &q2 : nullptr};
      const MapSummary summary = solver.solve(input, q);
      error.joint_m += scene.jointError(q, truth) / (3.0 * kFrames);
      error.iterations += summary.iterations / (3.0 * kFrames);
      q2 = q1;
      q1 = q;
    }
  }
  return error;
}

TEST(MapSolver, EachTermLowersTheErrorOfNoisyMarkers) {
  const double markers_only = track(MapConfig{}, false, false, 0).joint_m;
  const double with_prior = track(MapConfig{}, true, false, 0).joint_m;
  const TrackError all = track(MapConfig{}, true, true, 0);
  EXPECT_LT(with_prior, 0.92 * markers_only);
  EXPECT_LT(all.joint_m, 0.97 * with_prior);
  EXPECT_LT(all.joint_m, 0.02);
  EXPECT_LT(all.iterations, 5.0);  // as the paper reports
}

TEST(MapSolver, AllTermsBearMissingMarkersBetterThanMarkersAlone) {
  const double markers_only = track(MapConfig{}, false, false, 4).joint_m;
  const TrackError all = track(MapConfig{}, true, true, 4);
  EXPECT_LT(all.joint_m, 0.8 * markers_only);
  EXPECT_LT(all.joint_m, 0.03);
}

// The paper's constant velocity amplifies noise where no marker holds a DoF; expecting no motion does not.
TEST(MapSolver, ALowerVelocityShareBearsMissingMarkersBetter) {
  MapConfig still;
  still.velocity_share = 0.0;
  EXPECT_LT(track(still, true, true, 4).joint_m, 0.9 * track(MapConfig{}, true, true, 4).joint_m);
}

TEST(MapSolver, AStrayMarkerDoesNotPullThePose) {
  const MovingBody scene;
  MapSolver solver{MapConfig{}};
  const Pose truth = MovingBody::motion(2, 1.0);
  MarkerSet markers = scene.markers(truth);
  markers.position.col(partIndex(Part::LeftLowerArm)).array() += 1.0;
  const LocalPrior prior = MovingBody::priorOf(posesAround(2, 1.0), 5);
  const Pose q1 = MovingBody::motion(2, 1.0 - kFrame_s);
  const Pose q2 = MovingBody::motion(2, 1.0 - 2 * kFrame_s);
  Pose q = q1;
  solver.solve({scene.skeleton, scene.model, markers, &prior, &q1, &q2}, q);
  EXPECT_LT(scene.jointError(q, truth), 0.02);
}

TEST(MapSolver, JointLimitsKeepKneesFromBendingBackwards) {
  const MovingBody scene;
  Pose impossible = Pose::Zero();
  impossible[kRtibiaRx] = -0.8;
  const MarkerSet markers = scene.markers(impossible);
  const auto knee = [&](double lambda_limit) {
    MapConfig config;
    config.lambda_limit = lambda_limit;
    MapSolver solver(config);
    Pose q = Pose::Zero();
    solver.solve({scene.skeleton, scene.model, markers}, q);
    return q[kRtibiaRx];
  };
  EXPECT_LT(knee(0.0), -0.6);
  EXPECT_GT(knee(1000.0), jointLimits().lower[kRtibiaRx] - 0.1);
}

TEST(MapSolver, WithoutMarkersThePriorAndTheMotionCarryOn) {
  const MovingBody scene;
  MapSolver solver{MapConfig{}};
  const MarkerSet none;
  const LocalPrior prior = MovingBody::priorOf(posesAround(1, 1.0), 5);
  const Pose q1 = MovingBody::motion(1, 1.0 - kFrame_s);
  const Pose q2 = MovingBody::motion(1, 1.0 - 2 * kFrame_s);
  Pose q = q1;
  const MapSummary summary = solver.solve({scene.skeleton, scene.model, none, &prior, &q1, &q2}, q);
  EXPECT_TRUE(q.allFinite());
  EXPECT_EQ(summary.e_marker, 0);
  EXPECT_LT(scene.jointError(q, MovingBody::motion(1, 1.0)), 0.02);
}

TEST(MapSolver, WithNothingAtAllThePoseStays) {
  const MovingBody scene;
  MapSolver solver{MapConfig{}};
  const MarkerSet none;
  Pose q = clampedToLimits(MovingBody::motion(1, 1.0));
  const Pose start = q;
  EXPECT_TRUE(solver.solve({scene.skeleton, scene.model, none}, q).converged);
  EXPECT_EQ(q, start);
}

TEST(MapSolver, HeadingComesBackWrapped) {
  const MovingBody scene;
  MapSolver solver{MapConfig{}};
  Pose truth = MovingBody::motion(1, 1.0);
  truth[kRootRy] = std::numbers::pi + 0.1;
  const MarkerSet markers = scene.markers(truth);
  Pose q = truth;
  q[kRootRy] -= 0.2;
  solver.solve({scene.skeleton, scene.model, markers}, q);
  EXPECT_NEAR(q[kRootRy], 0.1 - std::numbers::pi, 0.03);
}

TEST(MapSolver, SameInputSameBytes) {
  const MovingBody scene;
  Random random(9);
  const MarkerSet markers = scene.noisyMarkers(MovingBody::motion(1, 1.0), 0.02, 3, random);
  MapSolver solver{MapConfig{}};
  Pose a = MovingBody::motion(1, 0.9);
  Pose other = MovingBody::motion(5, 0.4);
  Pose b = a;
  solver.solve({scene.skeleton, scene.model, markers}, a);
  solver.solve({scene.skeleton, scene.model, markers}, other);
  solver.solve({scene.skeleton, scene.model, markers}, b);
  EXPECT_EQ(a, b);
}

TEST(MapSolver, IterationLimitIsKept) {
  const MovingBody scene;
  MapConfig config;
  config.max_iterations = 1;
  MapSolver solver(config);
  const MarkerSet markers = scene.markers(MovingBody::motion(1, 1.0));
  Pose q = MovingBody::motion(1, 0.6);
  const MapSummary summary = solver.solve({scene.skeleton, scene.model, markers}, q);
  EXPECT_FALSE(summary.converged);
  EXPECT_EQ(summary.iterations, 1);
}

TEST(MapConfig, RefusesValuesOutOfRangeByName) {
  const auto message = [](auto change) -> std::string {
    MapConfig config;
    change(config);
    try {
      MapSolver solver(config);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message([](MapConfig& c) { c.sigma_m = 0; }).find("sigma_m"), std::string::npos);
  EXPECT_NE(message([](MapConfig& c) { c.lambda_smooth = -1; }).find("lambda_smooth"), std::string::npos);
  EXPECT_NE(message([](MapConfig& c) { c.velocity_share = 1.1; }).find("velocity_share"), std::string::npos);
  EXPECT_NE(message([](MapConfig& c) { c.max_iterations = 0; }).find("max_iterations"), std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message([&](MapConfig& c) { c.lambda_prior = nan; }).find("lambda_prior"), std::string::npos);
  EXPECT_EQ(message([](MapConfig&) {}), "");
}

}  // namespace
}  // namespace depthmocap

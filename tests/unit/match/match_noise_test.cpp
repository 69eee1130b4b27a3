#include "libtracker/match/match_noise.h"

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {
namespace {

constexpr MatchNoise::Range kRange{0.010, 0.5, 6.0, 2.0};

// Matches of points of the pelvis that were measured with a normal error.
SurfaceMatches measured(const ForwardKinematics& fk, double deviation_m, Random& random) {
  SurfaceMatches matches;
  for (int i = 0; i < 300; ++i) {
    SurfaceMatch match;
    match.model = {Bone::Root, {0.01 * (i % 20), 0.0, 0.1}};
    match.n_world = Eigen::Vector3d::UnitZ();
    match.p_world = fk.position(match.model) + deviation_m * random.normal() * match.n_world;
    match.weight = 1;
    matches.push_back(match);
  }
  return matches;
}

MatchNoise noiseAfter(int frames, double deviation_m, double share_of_outliers = 0) {
  ForwardKinematics fk;
  fk.update(makeSkeleton(BoneLengths{}), Pose::Zero());
  Random random(1);
  MatchNoise noise(kRange, kRange.usual_m);
  for (int i = 0; i < frames; ++i) {
    SurfaceMatches matches = measured(fk, deviation_m, random);
    for (SurfaceMatch& match : matches) {
      if (random.uniform(0, 1) < share_of_outliers) match.p_world.z() += 0.2;
    }
    noise.observe(matches, fk);
  }
  return noise;
}

TEST(MatchNoise, LearnsTheDeviationOfTheMeasuredPoints) {
  for (const double deviation_m : {0.003, 0.006, 0.010}) {
    EXPECT_NEAR(noiseAfter(60, deviation_m).deviation_m(), deviation_m, 0.12 * deviation_m);
  }
}

TEST(MatchNoise, APreciseCameraCountsMoreWithinLimits) {
  EXPECT_DOUBLE_EQ(MatchNoise(kRange, kRange.usual_m).information(), 1.0);
  EXPECT_NEAR(noiseAfter(60, 0.005).information(), 4.0, 0.6);
  EXPECT_DOUBLE_EQ(noiseAfter(60, 0.0001).information(), 6.0);
  EXPECT_DOUBLE_EQ(noiseAfter(60, 0.05).information(), 0.5);
}

TEST(MatchNoise, UntrustedMatchesHaveToProveThemselves) {
  MatchNoise noise({0.010, 0.01, 1.5, 4.0}, 0.02);
  EXPECT_NEAR(noise.information(), 1.0 / 16.0, 1e-9);
  ForwardKinematics fk;
  fk.update(makeSkeleton(BoneLengths{}), Pose::Zero());
  Random random(1);
  for (int i = 0; i < 60; ++i) noise.observe(measured(fk, 0.010, random), fk);
  EXPECT_NEAR(noise.information(), 1.0, 0.5);
}

TEST(MatchNoise, WrongMatchesHardlyCount) {
  EXPECT_LT(noiseAfter(60, 0.006, 0.05).deviation_m(), 0.0095);
}

TEST(MatchNoise, AFrameWithoutMatchesChangesNothing) {
  MatchNoise noise = noiseAfter(10, 0.005);
  const double before = noise.deviation_m();
  noise.observe({}, ForwardKinematics{});
  EXPECT_EQ(noise.deviation_m(), before);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/solve/surface_term.h"

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/match/surface_matcher.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/unit/solve/term_check.h"

namespace depthmocap {
namespace {

Pose randomPose(Random& random) {
  Pose q;
  for (int i = 0; i < kDofCount; ++i) q[i] = random.uniform(-0.6, 0.6);
  return q;
}

Eigen::Vector3d randomVector(Random& random) {
  return {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
}

// A point in front of the chest of a body that stands 2 m before the camera and faces it.
struct ChestScene {
  Skeleton skeleton = makeSkeleton(BoneLengths{});
  Pose q = Pose::Zero();
  ForwardKinematics fk;
  SurfaceModel surface;
  ChestScene() {
    q[kRootTz] = -2.0;
    fk.update(skeleton, q);
    surface.stature_m = statureOf(skeleton.lengths);
    surface.parts[static_cast<std::size_t>(partIndex(Part::Torso))].push_back(
        {Bone::UpperBack, {0.0F, 0.1F, 0.12F}, {0.0F, 0.0F, 1.0F}});
    surface.parts[static_cast<std::size_t>(partIndex(Part::Torso))].push_back(
        {Bone::UpperBack, {0.0F, 0.1F, -0.12F}, {0.0F, 0.0F, -1.0F}});
  }
  PlacedSurface placed() const {
    PlacedSurface result;
    result.place(surface, 1.0, fk);
    return result;
  }
  SurfaceSample sampleAhead(float ahead_m) const {
    SurfaceSample sample;
    sample.p_world = (fk.origin(Bone::UpperBack)).cast<float>() + Eigen::Vector3f(0.0F, 0.1F, 0.12F + ahead_m);
    sample.probability[static_cast<std::size_t>(partIndex(Part::Torso))] = 1.0F;
    return sample;
  }
};

SurfaceMatches randomMatches(int count, Random& random) {
  SurfaceMatches matches;
  for (int i = 0; i < count; ++i) {
    SurfaceMatch match;
    match.model = {static_cast<Bone>(i % kBoneCount), 0.2 * randomVector(random)};
    match.p_world = randomVector(random);
    match.n_world = randomVector(random).normalized();
    match.weight = random.uniform(0.1, 1.0);
    matches.push_back(match);
  }
  return matches;
}

TEST(SurfaceTerm, EnergyIsTheWeighedSquaredDistanceFromThePlanes) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  SurfaceMatches matches(2);
  matches[0] = {{Bone::Root, Eigen::Vector3d::Zero()}, {0.03, 7.0, 7.0}, Eigen::Vector3d::UnitX(), 1.0};
  matches[1] = {{Bone::Root, {0.0, 0.0, 0.2}}, {7.0, 7.0, 0.26}, Eigen::Vector3d::UnitZ(), 0.5};
  const SurfaceTerm term(&matches, 2.0, 0.03);
  EXPECT_NEAR(energyOf(term, skeleton, Pose::Zero()), 2.0 * (0.5 + 0.5 * 2.0), 1e-9);
}

TEST(SurfaceTerm, GradientMatchesDifferences) {
  Random random(5);
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  const SurfaceMatches matches = randomMatches(40, random);
  expectGradientMatches(SurfaceTerm(&matches, 2.0, 0.03), skeleton, randomPose(random), 1e-5);
}

TEST(SurfaceTerm, IsSilentWithoutMatches) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  const SurfaceTerm term(nullptr, 2.0, 0.03);
  EXPECT_EQ(energyOf(term, skeleton, Pose::Zero()), 0.0);
  EXPECT_EQ(equationsOf(term, skeleton, Pose::Zero()).A.norm(), 0.0);
}

TEST(SurfaceMatcher, TakesThePointThatFacesTheCamera) {
  const ChestScene scene;
  SurfaceMatcher matcher{SurfaceMatchConfig{}};
  SurfaceMatches matches;
  matcher.observe({scene.sampleAhead(0.01F)}, Matching::ByParts);
  matcher.match(scene.placed(), matches);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_NEAR(matches[0].model.p_bone.z(), 0.12, 1e-6);
  EXPECT_NEAR(matches[0].n_world.z(), 1.0, 1e-6);
}

TEST(SurfaceMatcher, LeavesOutWhatIsFarAway) {
  const ChestScene scene;
  SurfaceMatcher matcher{SurfaceMatchConfig{}};
  SurfaceMatches matches;
  matcher.observe({scene.sampleAhead(0.5F)}, Matching::ByParts);
  matcher.match(scene.placed(), matches);
  EXPECT_TRUE(matches.empty());
}

TEST(SurfaceMatcher, WeighsADistantMatchLess) {
  const ChestScene scene;
  SurfaceMatcher matcher{SurfaceMatchConfig{}};
  SurfaceMatches matches;
  matcher.observe({scene.sampleAhead(0.0F), scene.sampleAhead(0.1F)}, Matching::ByParts);
  matcher.match(scene.placed(), matches);
  ASSERT_EQ(matches.size(), 2U);
  EXPECT_GT(matches[0].weight, 0.99);
  EXPECT_LT(matches[1].weight, 0.5);
}

TEST(SurfaceMatcher, LooksAtNoMoreSamplesThanAsked) {
  const ChestScene scene;
  SurfaceMatchConfig config;
  config.max_matches = 5;
  SurfaceMatcher matcher{config};
  SurfaceMatches matches;
  matcher.observe(std::vector<SurfaceSample>(40, scene.sampleAhead(0.0F)), Matching::ByParts);
  matcher.match(scene.placed(), matches);
  EXPECT_EQ(matches.size(), 5U);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/solve/surface_term.h"

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/match/surface_matcher.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/gradient_check.h"

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

// One residual a match, as the term is defined.
double plainEnergy(const Skeleton& skeleton, const SurfaceMatches& matches, double lambda, double sigma_m,
                   const Pose& q) {
  ForwardKinematics fk;
  fk.update(skeleton, q);
  double energy = 0;
  for (const SurfaceMatch& match : matches) {
    const double off = match.n_world.dot(fk.position(match.model) - match.p_world);
    energy += lambda * match.weight * off * off / (2.0 * sigma_m * sigma_m);
  }
  return energy;
}

TEST(SurfaceTerm, EnergyIsThatOfAllMatches) {
  Random random(6);
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  for (const int count : {1, 17, 100, kMaxSurfaceMatches}) {
    SurfaceMatches matches = randomMatches(count, random);
    const Pose q = randomPose(random);
    ForwardKinematics fk;
    fk.update(skeleton, q);
    for (const double noise_m : {1.0, 0.01, 1e-4}) {
      for (SurfaceMatch& match : matches) {
        match.p_world = fk.position(match.model) + noise_m * (match.p_world - fk.position(match.model));
      }
      SurfaceTerm term(skeleton, &matches, 2.0, 0.03);
      Eigen::VectorXd r(SurfaceTerm::kRows);
      term.evaluate(q, r, nullptr);
      const double plain = plainEnergy(skeleton, matches, 2.0, 0.03, q);
      EXPECT_NEAR(r.squaredNorm(), plain, 1e-6 * plain + 1e-7) << count << " matches, " << noise_m << " m";
    }
  }
}

TEST(SurfaceTerm, JacobianMatchesDifferences) {
  Random random(5);
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  const SurfaceMatches matches = randomMatches(40, random);
  SurfaceTerm term(skeleton, &matches, 2.0, 0.03);
  const Eigen::VectorXd q = randomPose(random);
  const auto residual = [&](const Eigen::VectorXd& x) {
    Eigen::VectorXd r(SurfaceTerm::kRows);
    term.evaluate(x, r, nullptr);
    return r;
  };
  const auto jacobian = [&](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
    Eigen::Matrix<double, Eigen::Dynamic, kDofCount> J(SurfaceTerm::kRows, kDofCount);
    Eigen::VectorXd r(SurfaceTerm::kRows);
    JacobianRows rows = J;
    term.evaluate(x, r, &rows);
    return J;
  };
  expectJacobianMatches(q, residual, jacobian, 1e-5);
}

TEST(SurfaceTerm, IsSilentWithoutMatches) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  SurfaceTerm term(skeleton, nullptr, 2.0, 0.03);
  Eigen::VectorXd r = Eigen::VectorXd::Ones(SurfaceTerm::kRows);
  term.evaluate(Pose::Zero(), r, nullptr);
  EXPECT_EQ(r.squaredNorm(), 0.0);
}

TEST(SurfaceMatcher, TakesThePointThatFacesTheCamera) {
  const ChestScene scene;
  SurfaceMatcher matcher{SurfaceMatchConfig{}};
  SurfaceMatches matches;
  matcher.match(scene.placed(), {scene.sampleAhead(0.01F)}, matches);
  ASSERT_EQ(matches.size(), 1U);
  EXPECT_NEAR(matches[0].model.p_bone.z(), 0.12, 1e-6);
  EXPECT_NEAR(matches[0].n_world.z(), 1.0, 1e-6);
}

TEST(SurfaceMatcher, LeavesOutWhatIsFarAway) {
  const ChestScene scene;
  SurfaceMatcher matcher{SurfaceMatchConfig{}};
  SurfaceMatches matches;
  matcher.match(scene.placed(), {scene.sampleAhead(0.5F)}, matches);
  EXPECT_TRUE(matches.empty());
}

TEST(SurfaceMatcher, WeighsADistantMatchLess) {
  const ChestScene scene;
  SurfaceMatcher matcher{SurfaceMatchConfig{}};
  SurfaceMatches matches;
  matcher.match(scene.placed(), {scene.sampleAhead(0.0F), scene.sampleAhead(0.1F)}, matches);
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
  matcher.match(scene.placed(), std::vector<SurfaceSample>(40, scene.sampleAhead(0.0F)), matches);
  EXPECT_EQ(matches.size(), 5U);
}

}  // namespace
}  // namespace depthmocap

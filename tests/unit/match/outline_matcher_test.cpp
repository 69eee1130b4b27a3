#include "libtracker/match/outline_matcher.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "depthmocap/world_frame.h"

namespace depthmocap {
namespace {

constexpr double kRadius_m = 0.08;
constexpr double kDistance_m = 2.5;
constexpr double kHalfLength_m = 0.30;

// A post that stands before the camera: points of its side, rigid with the root.
SurfaceModel post(double radius_m) {
  SurfaceModel model;
  model.stature_m = 1.7;
  auto& points = model.parts[static_cast<std::size_t>(partIndex(Part::Torso))];
  for (int i = 0; i < 180; ++i) {
    const double angle = i * std::numbers::pi / 90.0;
    const Eigen::Vector3d n(std::sin(angle), 0.0, std::cos(angle));
    for (int j = -10; j <= 10; ++j) {
      const Eigen::Vector3d p = radius_m * n + Eigen::Vector3d(0.0, 0.1 * kHalfLength_m * j, 0.0);
      points.push_back({Bone::Root, p.cast<float>(), n.cast<float>()});
    }
  }
  return model;
}

struct Scene {
  CameraModel camera;
  DepthImage depth;
  MaskImage mask;
  ForwardKinematics fk;
};

// The picture of a post of kRadius_m, `shift_m` to the right of where the pose says; what is beside it is
// `beside_m` away (0: not measured).
Scene sceneOf(double shift_m, float beside_m) {
  Scene scene;
  scene.camera.width = 640;
  scene.camera.height = 480;
  scene.camera.fx = scene.camera.fy = 525;
  scene.camera.cx = 320;
  scene.camera.cy = 240;
  scene.depth.reset(640, 480, beside_m);
  scene.mask.reset(640, 480, 0);
  Pose q = Pose::Zero();
  q[kRootTz] = -kDistance_m;
  scene.fk.update(makeSkeleton(averageBoneLengths(1.7)), q);
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double u = (x - 320.0) / 525.0;
      const double v = (y - 240.0) / 525.0;
      const double along = kDistance_m * u - shift_m;  // where the line of sight passes the axis, to a good part
      if (std::abs(along) > kRadius_m || std::abs(kDistance_m * v) > kHalfLength_m) continue;
      scene.mask.at(x, y) = 1;
      scene.depth.at(x, y) = static_cast<float>(kDistance_m - std::sqrt(kRadius_m * kRadius_m - along * along));
    }
  }
  return scene;
}

SurfaceMatches matchesOf(const Scene& scene, const SurfaceModel& model) {
  OutlineMatcher matcher(OutlineConfig{});
  matcher.observe(scene.depth, scene.mask, scene.camera, uprightWorldFromCamera());
  SurfaceMatches matches;
  matcher.match(model, 1.0, scene.fk, matches);
  return matches;
}

// Mean distance of the model's rim outside the lines of sight [m], to the right and to the left.
struct Sides {
  double right = 0, left = 0;
  int count = 0;
};
Sides sidesOf(const Scene& scene, const SurfaceMatches& matches) {
  Sides sides;
  int right = 0;
  int left = 0;
  for (const SurfaceMatch& match : matches) {
    if (std::abs(match.n_world.x()) < 0.9) continue;
    const double off = match.n_world.dot(scene.fk.position(match.model) - match.p_world);
    (match.n_world.x() > 0 ? sides.right : sides.left) += off;
    ++(match.n_world.x() > 0 ? right : left);
  }
  sides.count = std::min(right, left);
  sides.right /= right;
  sides.left /= left;
  return sides;
}

TEST(OutlineMatcher, TouchesABodyOfTheRightWidthInTheRightPlace) {
  const Scene scene = sceneOf(0, 4.0F);
  const SurfaceMatches matches = matchesOf(scene, post(kRadius_m));
  for (const SurfaceMatch& match : matches) EXPECT_GT(match.weight, 0.9 * OutlineConfig{}.weight);
  const Sides sides = sidesOf(scene, matches);
  EXPECT_GT(sides.count, 50);
  EXPECT_NEAR(sides.right, 0, 0.004);
  EXPECT_NEAR(sides.left, 0, 0.004);
}

TEST(OutlineMatcher, TellsHowMuchTooThickABodyIs) {
  const Scene scene = sceneOf(0, 0.0F);
  const Sides sides = sidesOf(scene, matchesOf(scene, post(kRadius_m + 0.02)));
  EXPECT_NEAR(sides.right, 0.02, 0.004);
  EXPECT_NEAR(sides.left, 0.02, 0.004);
}

TEST(OutlineMatcher, TellsThatABodyStandsBesideItsPose) {
  const Scene scene = sceneOf(0.03, 4.0F);
  const Sides sides = sidesOf(scene, matchesOf(scene, post(kRadius_m)));
  EXPECT_NEAR(sides.right, -0.03, 0.005);
  EXPECT_NEAR(sides.left, 0.03, 0.005);
}

TEST(OutlineMatcher, IsNoneWhereSomethingStandsBeforeTheBody) {
  const Scene scene = sceneOf(0, 2.0F);
  EXPECT_TRUE(matchesOf(scene, post(kRadius_m)).empty());
}

TEST(OutlineMatcher, IsNoneOfAnEmptyMask) {
  Scene scene = sceneOf(0, 4.0F);
  scene.mask.reset(640, 480, 0);
  EXPECT_TRUE(matchesOf(scene, post(kRadius_m)).empty());
}

}  // namespace
}  // namespace depthmocap

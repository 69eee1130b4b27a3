#include "forest/render/props.h"

#include <gtest/gtest.h>

#include "forest/render/training_view.h"
#include "libtracker/body/builtin_body.h"

namespace depthmocap {
namespace {

const BodySurface& body() {
  static const BodySurface surface = makeBuiltinBody(BodyShape{});
  return surface;
}

// The same actor from the same place, whatever is carried and whatever stands before him.
TrainingView viewWith(double carried_share, double obstacle_share, std::uint64_t seed) {
  TrainingViewConfig config;
  config.carried_share = carried_share;
  config.obstacle_share = obstacle_share;
  config.noise_share = 0;
  config.min_distance_m = 2.0;
  TrainingViewRenderer renderer(config);
  TrainingView view;
  Random random(seed);
  renderer.render(body(), Pose::Zero(), random, view);
  return view;
}

struct Pixels {
  int actor = 0;    // with a part
  int carried = 0;  // measured, without a part
};

Pixels pixelsOf(const TrainingView& view) {
  Pixels count;
  for (std::size_t i = 0; i < view.depth.data.size(); ++i) {
    if (view.parts.data[i] != 0) {
      EXPECT_GT(view.depth.data[i], 0.0F);
      EXPECT_LE(view.parts.data[i], kPartCount);
      ++count.actor;
    } else if (view.depth.data[i] > 0.0F) {
      ++count.carried;
    }
  }
  return count;
}

TEST(Props, AnActorAloneIsAllParts) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) EXPECT_EQ(pixelsOf(viewWith(0, 0, seed)).carried, 0);
}

TEST(Props, WhatIsCarriedIsSeenAndHasNoPart) {
  int seen = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Pixels alone = pixelsOf(viewWith(0, 0, seed));
    const Pixels with = pixelsOf(viewWith(1, 0, seed));
    EXPECT_LE(with.actor, alone.actor) << seed;
    EXPECT_GT(with.actor, alone.actor / 2) << seed;
    seen += with.carried > 0 ? 1 : 0;
  }
  EXPECT_GE(seen, 8);  // a rucksack is hidden from the front
}

TEST(Props, ObstaclesHideTheActorAndAreNotInThePicture) {
  int hidden = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const TrainingView alone = viewWith(0, 0, seed);
    const TrainingView behind = viewWith(0, 1, seed);
    EXPECT_EQ(alone.q_world, behind.q_world);
    for (std::size_t i = 0; i < alone.depth.data.size(); ++i) {
      if (behind.depth.data[i] > 0.0F) {
        ASSERT_EQ(behind.parts.data[i], alone.parts.data[i]);
        ASSERT_EQ(behind.depth.data[i], alone.depth.data[i]);
      }
    }
    const double left = static_cast<double>(pixelsOf(behind).actor) / pixelsOf(alone).actor;
    hidden += left < 0.98 ? 1 : 0;
  }
  EXPECT_GE(hidden, 8);
}

TEST(Props, NothingStandsBetweenWhereThereIsNoRoom) {
  TriangleMesh mesh;
  Random random(1);
  addObstacle({Eigen::Vector3d(-0.5, 0, -1.0), Eigen::Vector3d(0.5, 1.7, -0.55)}, random, mesh);
  EXPECT_TRUE(mesh.triangles.empty());
  addObstacle({Eigen::Vector3d(-0.5, 0, -2.0), Eigen::Vector3d(0.5, 1.7, -1.6)}, random, mesh);
  EXPECT_FALSE(mesh.triangles.empty());
  EXPECT_EQ(mesh.part.size(), mesh.triangles.size());
}

TEST(Props, EqualSeedsCarryEqualThings) {
  const auto carried = [](std::uint64_t seed) {
    TriangleMesh mesh;
    Random random(seed);
    addCarried(body().skeleton, Pose::Zero(), random, mesh);
    return mesh.vertices;
  };
  EXPECT_EQ(carried(3), carried(3));
  EXPECT_NE(carried(3), carried(4));
}

}  // namespace
}  // namespace depthmocap

#include "forest/render/scene_view.h"

#include <set>

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"

namespace depthmocap {
namespace {

const BodySurface& body() {
  static const BodySurface surface = makeBuiltinBody(BodyShape{});
  return surface;
}

Pose bentArms(Random& random) {
  Pose q = Pose::Zero();
  q[kLradiusRy] = -random.uniform(0, 1.5);
  q[kRradiusRy] = random.uniform(0, 1.5);
  return q;
}

SceneView viewOf(std::uint64_t seed, const SceneViewConfig& config = {}) {
  SceneViewRenderer renderer(config);
  Random random(seed);
  SceneView view;
  renderer.render({&body(), 1}, bentArms, random, view);
  return view;
}

TEST(SceneView, SameSeedSamePictureWhateverWasRenderedBefore) {
  SceneViewRenderer renderer;
  SceneView used;
  for (const std::uint64_t seed : {3U, 4U, 5U}) {
    Random random(seed);
    renderer.render({&body(), 1}, bentArms, random, used);
  }
  const SceneView fresh = viewOf(5);
  EXPECT_EQ(used.depth.data, fresh.depth.data);
  EXPECT_EQ(used.classes.data, fresh.classes.data);
  EXPECT_NE(used.depth.data, viewOf(6).depth.data);
}

TEST(SceneView, ClassesAreThoseOfWhatWasMeasured) {
  int with_actor = 0;
  std::set<SensorKind> sensors;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const SceneView view = viewOf(seed, {.empty_share = 0, .other_share = 0});
    sensors.insert(view.sensor);
    ASSERT_EQ(view.depth.data.size(), view.classes.data.size());
    int actor = 0;
    for (std::size_t i = 0; i < view.depth.data.size(); ++i) {
      ASSERT_LT(view.classes.data[i], kOtherPerson);
      if (view.classes.data[i] == 0) continue;
      ASSERT_GT(view.depth.data[i], 0.0F);
      ++actor;
    }
    with_actor += actor > 100 ? 1 : 0;
  }
  EXPECT_GT(with_actor, 34) << "the actor is in view";
  EXPECT_GT(sensors.size(), 5U);
}

TEST(SceneView, NobodyIsInAnEmptyRoom) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const SceneView view = viewOf(seed, {.empty_share = 1});
    EXPECT_EQ(view.scene, SceneKind::Empty);
    for (const std::uint8_t label : view.classes.data) ASSERT_EQ(label, 0);
  }
}

TEST(SceneView, TheOtherPersonHasOneClass) {
  int pixels = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const SceneView view = viewOf(seed, {.empty_share = 0, .other_share = 1});
    for (const std::uint8_t label : view.classes.data) {
      ASSERT_LE(label, kOtherPerson);
      pixels += label == kOtherPerson ? 1 : 0;
    }
  }
  EXPECT_GT(pixels, 1000);
}

}  // namespace
}  // namespace depthmocap

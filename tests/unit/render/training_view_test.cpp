#include "forest/render/training_view.h"

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

const BodySurface& body() {
  static const BodySurface surface = makeBuiltinBody(BodyShape{});
  return surface;
}

int actorPixels(const TrainingView& view) {
  int count = 0;
  for (const std::uint8_t part : view.parts.data) count += part != 0 ? 1 : 0;
  return count;
}

TEST(TrainingView, EqualSeedsGiveEqualViewsWhateverWasRenderedBefore) {
  TrainingViewRenderer fresh;
  TrainingViewRenderer used;
  TrainingView a;
  TrainingView b;
  Random other(9);
  for (int i = 0; i < 3; ++i) used.render(body(), Pose::Zero(), other, b);
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    Random random_a(seed);
    Random random_b(seed);
    fresh.render(body(), Pose::Zero(), random_a, a);
    used.render(body(), Pose::Zero(), random_b, b);
    EXPECT_EQ(a.depth.data, b.depth.data);
    EXPECT_EQ(a.parts.data, b.parts.data);
    EXPECT_EQ(a.q_world, b.q_world);
  }
}

TEST(TrainingView, TheActorIsInViewAndHolesAreHolesInBothImages) {
  TrainingViewRenderer renderer;
  TrainingView view;
  Random random(1);
  for (int i = 0; i < 25; ++i) {
    renderer.render(body(), Pose::Zero(), random, view);
    EXPECT_EQ(view.depth.width, view.camera.width);
    EXPECT_EQ(view.depth.height, view.camera.height);
    EXPECT_GT(actorPixels(view), 150) << i;
    for (std::size_t p = 0; p < view.depth.data.size(); ++p) {
      if (view.parts.data[p] != 0) {
        ASSERT_GT(view.depth.data[p], 0.0F);
      }
    }
  }
}

TEST(TrainingView, JointsLieJustBehindTheSurfaceThatIsSeen) {
  TrainingViewConfig config;
  config.noise_share = 0.0;
  config.cut_share = 0.0;
  config.min_distance_m = 2.5;
  TrainingViewRenderer renderer(config);
  TrainingView view;
  Random random(2);
  int seen = 0;
  for (int i = 0; i < 10; ++i) {
    renderer.render(body(), Pose::Zero(), random, view);
    const JointPositions joints = jointPositions(body().skeleton, view.q_world);
    for (const Joint joint : {Joint::Pelvis, Joint::Spine, Joint::Head, Joint::LeftKnee, Joint::RightKnee}) {
      const Eigen::Vector3d p = view.T_camera_world * joints.col(static_cast<int>(joint));
      const Eigen::Vector2d uv = view.camera.project(p);
      const int x = static_cast<int>(std::lround(uv.x()));
      const int y = static_cast<int>(std::lround(uv.y()));
      if (!view.depth.contains(x, y)) continue;
      ++seen;
      EXPECT_NE(view.parts.at(x, y), 0);
      EXPECT_LT(view.depth.at(x, y), p.z());
    }
  }
  EXPECT_GT(seen, 40);
}

TEST(TrainingView, DrawsAllSensorsSizesAndHeadings) {
  TrainingViewRenderer renderer;
  TrainingView view;
  Random random(3);
  int kinect2 = 0;
  int half_size = 0;
  int from_behind = 0;
  constexpr int kViews = 60;
  for (int i = 0; i < kViews; ++i) {
    renderer.render(body(), Pose::Zero(), random, view);
    kinect2 += view.sensor == SensorKind::Kinect2 ? 1 : 0;
    half_size += view.camera.width == 320 ? 1 : 0;
    from_behind += std::cos(view.q_world[kRootRy]) < 0.0 ? 1 : 0;
  }
  for (const int count : {kinect2, half_size, from_behind}) {
    EXPECT_GT(count, kViews / 12);
    EXPECT_LT(count, kViews * 5 / 6);
  }
}

}  // namespace
}  // namespace depthmocap

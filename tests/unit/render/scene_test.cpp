#include "forest/render/scene.h"

#include <gtest/gtest.h>

#include "tests/unit/render/test_meshes.h"

namespace depthmocap {
namespace {

const std::vector<Eigen::Vector3d> kPath = {{-0.5, 0.0, -2.5}, {0.0, 0.0, -2.8}, {0.5, 0.0, -3.0}};
constexpr double kFloor = -0.95;
constexpr std::size_t kShellVertices = 16;  // floor and three walls

TEST(Scene, RoomFillsTheView) {
  DepthRenderer renderer;
  renderer.setBackground(makeRoom(kFloor, kPath, 1));
  RenderedView view;
  const CameraModel camera{.width = 160, .height = 120, .fx = 144.0, .fy = 144.0, .cx = 79.5, .cy = 59.5};
  renderer.render(camera, testing::uprightCamera(), {}, view);
  int measured = 0;
  for (const float depth : view.depth.data) measured += depth > 0.0F ? 1 : 0;
  EXPECT_GT(measured, 0.85 * 160 * 120);  // above the walls is nothing
  const Eigen::Vector3d p = camera.unproject(80, 119, view.depth.at(80, 119));
  EXPECT_NEAR(-p.y(), kFloor, 1e-4);
}

TEST(Scene, FurnitureKeepsClearOfThePathAndOfTheView) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const TriangleMesh room = makeRoom(kFloor, kPath, seed);
    EXPECT_GT(room.vertices.size(), kShellVertices) << "no furniture";
    for (std::size_t i = kShellVertices; i < room.vertices.size(); ++i) {
      const Eigen::Vector3d v = room.vertices[i].cast<double>();
      EXPECT_GE(v.y(), kFloor - 1e-5);
      for (const Eigen::Vector3d& p : kPath) {
        EXPECT_GT((Eigen::Vector2d(v.x(), v.z()) - Eigen::Vector2d(p.x(), p.z())).norm(), 1.0);
        // Nothing nearer than the actor within a step of the line from the camera.
        const double along = v.z() / p.z();
        if (along > 0 && along < 1) {
          EXPECT_GT(std::abs(v.x() - along * p.x()), 0.5);
        }
      }
    }
  }
}

TEST(Scene, SeedsGiveDifferentRooms) {
  EXPECT_EQ(makeRoom(kFloor, kPath, 4).vertices, makeRoom(kFloor, kPath, 4).vertices);
  EXPECT_NE(makeRoom(kFloor, kPath, 4).vertices, makeRoom(kFloor, kPath, 5).vertices);
}

}  // namespace
}  // namespace depthmocap

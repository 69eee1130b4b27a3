#include "forest/render/depth_renderer.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/unit/render/test_meshes.h"

namespace depthmocap {
namespace {

using testing::ellipsoid;
using testing::setBody;
using testing::uprightCamera;
using testing::wall;

CameraModel smallCamera() {
  return {.width = 160, .height = 120, .fx = 144.0, .fy = 144.0, .cx = 79.5, .cy = 59.5};
}

TEST(DepthRenderer, PlaneAtKnownDistanceIsExact) {
  DepthRenderer renderer;
  renderer.setBackground(wall(2.5, 10.0));
  RenderedView view;
  renderer.render(smallCamera(), uprightCamera(), {}, view);
  for (const float depth : view.depth.data) EXPECT_NEAR(depth, 2.5, 1e-6);
  for (const std::uint8_t part : view.parts.data) EXPECT_EQ(part, 0);
}

TEST(DepthRenderer, TiltedPlaneFollowsItsEquation) {
  DepthRenderer renderer;
  TriangleMesh mesh = wall(3.0, 10.0);
  for (Eigen::Vector3f& v : mesh.vertices) v.z() += 0.25F * v.x();
  renderer.setBackground(mesh);
  RenderedView view;
  const CameraModel camera = smallCamera();
  renderer.render(camera, uprightCamera(), {.incidence = true, .p_camera_projector = {}}, view);
  for (int x = 0; x < camera.width; x += 13) {
    const Eigen::Vector3d p = camera.unproject(x, 40, view.depth.at(x, 40));
    EXPECT_NEAR(p.z(), 3.0 - 0.25 * p.x(), 1e-5);
    const Eigen::Vector3d normal = Eigen::Vector3d(0.25, 0.0, 1.0).normalized();
    EXPECT_NEAR(view.incidence.at(x, 40), std::abs(normal.dot(p.normalized())), 1e-5);
  }
}

TEST(DepthRenderer, SphereHasDepthAndPartsOnItsDiscOnly) {
  DepthRenderer renderer;
  const double radius = 0.4;
  setBody(renderer, ellipsoid({0.2, 0.1, -2.0}, {radius, radius, radius}, 60, Part::Torso));
  RenderedView view;
  const CameraModel camera = smallCamera();
  renderer.render(camera, uprightCamera(), {}, view);
  const Eigen::Vector3d center(0.2, -0.1, 2.0);
  int hits = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray = camera.unproject(x, y, 1.0).normalized();
      const double miss = (center - ray * ray.dot(center)).norm();
      const bool hit = view.depth.at(x, y) > 0.0F;
      if (std::abs(miss - radius) > 0.005) {
        EXPECT_EQ(hit, miss < radius) << x << " " << y;
      }
      EXPECT_EQ(view.parts.at(x, y), hit ? static_cast<int>(Part::Torso) : 0);
      if (!hit || miss > 0.9 * radius) continue;
      ++hits;
      EXPECT_NEAR((camera.unproject(x, y, view.depth.at(x, y)) - center).norm(), radius, 0.001);
    }
  }
  EXPECT_GT(hits, 500);
}

TEST(DepthRenderer, NearerSurfaceHidesTheFartherOne) {
  DepthRenderer renderer;
  setBody(renderer, ellipsoid({0.0, 0.0, -2.0}, {0.3, 0.3, 0.3}, 30, Part::Head));
  renderer.setBackground(wall(3.0, 10.0));
  RenderedView view;
  renderer.render(smallCamera(), uprightCamera(), {}, view);
  EXPECT_NEAR(view.depth.at(80, 60), 1.7, 0.002);
  EXPECT_EQ(view.parts.at(80, 60), static_cast<int>(Part::Head));
  EXPECT_NEAR(view.depth.at(5, 5), 3.0, 1e-5);
  renderer.setBackground(wall(1.0, 10.0));
  renderer.render(smallCamera(), uprightCamera(), {}, view);
  EXPECT_NEAR(view.depth.at(80, 60), 1.0, 1e-5);
  EXPECT_EQ(view.parts.at(80, 60), 0);
}

TEST(DepthRenderer, MovedCameraSeesTheSameAsMovedBody) {
  const Eigen::Vector3d move(0.3, -0.2, 0.4);
  DepthRenderer renderer;
  RenderedView moved_body;
  RenderedView moved_camera;
  setBody(renderer, ellipsoid(Eigen::Vector3d(0.0, 0.0, -2.0) + move, {0.3, 0.5, 0.2}, 40, Part::Torso));
  renderer.render(smallCamera(), uprightCamera(), {}, moved_body);
  setBody(renderer, ellipsoid({0.0, 0.0, -2.0}, {0.3, 0.5, 0.2}, 40, Part::Torso));
  renderer.render(smallCamera(), uprightCamera() * Eigen::Translation3d(move), {}, moved_camera);
  int differing = 0;
  for (std::size_t i = 0; i < moved_body.depth.data.size(); ++i) {
    differing += std::abs(moved_body.depth.data[i] - moved_camera.depth.data[i]) > 1e-3F ? 1 : 0;
  }
  EXPECT_LT(differing, 5);  // rounding of the vertices can move a silhouette pixel
}

TEST(DepthRenderer, ProjectorShadowLiesOnTheFarSideOfAnObject) {
  DepthRenderer renderer;
  renderer.setBackground(wall(3.0, 10.0));
  TriangleMesh object = wall(1.5, 0.2);
  object.part.assign(object.triangles.size(), static_cast<std::uint8_t>(Part::Torso));
  setBody(renderer, object);
  RenderedView view;
  const CameraModel camera = smallCamera();
  renderer.render(camera, uprightCamera(), {.incidence = false, .p_camera_projector = Eigen::Vector3d(0.075, 0, 0)},
                  view);
  // The projector on the right throws the edge x = -0.2 at 1.5 m to x = -0.475 at 3 m; the camera sees it at -0.4.
  int shadow = 0;
  for (int x = 0; x < camera.width; ++x) {
    if (view.lit.at(x, 60) != 0) continue;
    ++shadow;
    const double at_wall = camera.unproject(x, 60, 3.0).x();
    EXPECT_GT(at_wall, -0.475 - 0.02);
    EXPECT_LT(at_wall, -0.4 + 0.02);
  }
  EXPECT_NEAR(shadow, 0.075 / 3.0 * camera.fx, 1.5);
}

TEST(DepthRenderer, BodyBehindTheCameraOrGoneLeavesAnEmptyPicture) {
  DepthRenderer renderer;
  setBody(renderer, ellipsoid({0.0, 0.0, 2.0}, {0.3, 0.3, 0.3}, 10, Part::Head));
  RenderedView view;
  renderer.render(smallCamera(), uprightCamera(), {}, view);
  for (const float depth : view.depth.data) EXPECT_EQ(depth, 0.0F);
  setBody(renderer, ellipsoid({0.0, 0.0, -2.0}, {0.3, 0.3, 0.3}, 10, Part::Head));
  renderer.render(smallCamera(), uprightCamera(), {}, view);
  EXPECT_GT(view.depth.at(80, 60), 0.0F);
  setBody(renderer, {});
  renderer.render(smallCamera(), uprightCamera(), {}, view);
  for (const float depth : view.depth.data) EXPECT_EQ(depth, 0.0F);
}

TEST(DepthRenderer, PartsMustMatchTriangles) {
  DepthRenderer renderer;
  TriangleMesh mesh = wall(1.0, 1.0);
  EXPECT_THROW(setBody(renderer, mesh), std::logic_error);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/recording/undistort.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

CameraModel distortedCamera() {
  CameraModel camera;
  camera.width = 64;
  camera.height = 48;
  camera.fx = camera.fy = 50;
  camera.cx = 32;
  camera.cy = 24;
  camera.distortion = {0.1, 0, 0, 0, 0};
  return camera;
}

TEST(Undistort, LeavesThePictureWithoutDistortion) {
  CameraModel camera = distortedCamera();
  camera.distortion = {};
  const auto map = undistortionMap(camera);
  for (std::size_t i = 0; i < map.size(); ++i) ASSERT_EQ(map[i], static_cast<std::int32_t>(i));
}

// x = (57 - 32) / 50 = 0.5 on the axis y = 0: r^2 = 0.25, x (1 + 0.1 * 0.25) = 0.5125, pixel 32 + 25.625 -> 58.
TEST(Undistort, TakesTheNearestPixelOfAHandComputedRadialCase) {
  const auto map = undistortionMap(distortedCamera());
  EXPECT_EQ(map[24 * 64 + 57], 24 * 64 + 58);
  EXPECT_EQ(map[24 * 64 + 32], 24 * 64 + 32);
}

// x = 0.5, y = 0, r^2 = 0.25: p2 adds p2 (r^2 + 2 x^2) = 0.04 * 0.75 = 0.03 to x, p1 adds p1 r^2 = 0.08 * 0.25 = 0.02
// to y.
TEST(Undistort, TakesTheNearestPixelOfAHandComputedTangentialCase) {
  CameraModel camera = distortedCamera();
  camera.distortion = {0, 0, 0.08, 0.04, 0};
  // 32 + 50 * 0.53 = 58.5 -> 59 and 24 + 50 * 0.02 = 25
  EXPECT_EQ(undistortionMap(camera)[24 * 64 + 57], 25 * 64 + 59);
}

TEST(Undistort, HasNoSourceOutsideThePictureNorWhereTheLensModelOverflows) {
  EXPECT_EQ(undistortionMap(distortedCamera())[0], -1);
  CameraModel camera = distortedCamera();
  camera.distortion = {1e300, 1e300, 0, 0, -1e300};
  EXPECT_EQ(undistortionMap(camera)[0], -1);
}

TEST(Undistort, NeverMixesDepthAcrossAnEdge) {
  const CameraModel camera = distortedCamera();
  Image<std::uint16_t> raw(camera.width, camera.height);
  for (int y = 0; y < raw.height; ++y) {
    for (int x = 0; x < raw.width; ++x) raw.at(x, y) = x < 40 ? 1000 : 3000;
  }
  DepthImage depth;
  toMetres(raw, 0.001, undistortionMap(camera), depth);
  for (const float d : depth.data) EXPECT_TRUE(d == 0.0F || d == 1.0F || d == 3.0F) << d;
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/recording/turned_recording.h"

#include <gtest/gtest.h>

#include "tests/support/made_recording.h"

namespace depthmocap {
namespace {

class TurnedRecording : public testing::TestWithParam<int> {};

// A pixel and its depth give the same point of space before and after, seen in the turned frame.
TEST_P(TurnedRecording, KeepsThePointOfEachPixel) {
  CameraModel camera = smallCamera(8, 6).camera;
  camera.fy = 9;
  camera.cx = 3.25;
  camera.cy = 2.75;
  const DepthImage depth = patternDepth(camera, 3);
  DepthImage turned;
  turnDepth(depth, GetParam(), turned);
  const CameraModel upright = turnedCamera(camera, GetParam());
  ASSERT_EQ(turned.width, upright.width);
  ASSERT_EQ(turned.height, upright.height);
  for (int v = 0; v < depth.height; ++v) {
    for (int u = 0; u < depth.width; ++u) {
      Eigen::Vector3d p = camera.unproject(u, v, 1.0);
      for (int done = 0; done < GetParam(); done += 90) p = Eigen::Vector3d(-p.y(), p.x(), p.z());
      const Eigen::Vector2d pixel = upright.project(p);
      const int x = static_cast<int>(std::lround(pixel.x()));
      const int y = static_cast<int>(std::lround(pixel.y()));
      ASSERT_NEAR(pixel.x(), x, 1e-9);
      ASSERT_NEAR(pixel.y(), y, 1e-9);
      ASSERT_EQ(turned.at(x, y), depth.at(u, v));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Turns, TurnedRecording, testing::Values(0, 90, 180, 270));

}  // namespace
}  // namespace depthmocap

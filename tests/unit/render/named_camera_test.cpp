#include "forest/render/named_camera.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "forest/render/sensor_model.h"
#include "tests/unit/render/test_meshes.h"

namespace depthmocap {
namespace {

using testing::uprightCamera;
using testing::wall;

// What a camera of some kind measures of a board at 1.5 m, 0.6 m wide, before a wall at 4 m.
struct Sensed {
  CameraModel camera;
  RenderedView clean;
  DepthImage depth;
  PartImage parts;

  [[nodiscard]] float at(double x_m, double y_m, double z_m) const {
    const Eigen::Vector2d uv = camera.project({x_m, y_m, z_m});
    return depth.at(static_cast<int>(std::lround(uv.x())), static_cast<int>(std::lround(uv.y())));
  }
  // Of the pixels of a square around the middle of the picture, those without measurement, on each side of the board.
  [[nodiscard]] int missing(bool left) const {
    int count = 0;
    for (int y = camera.height / 3; y < 2 * camera.height / 3; ++y) {
      for (int d = 0; d < camera.width / 10; ++d) {
        const auto edge = static_cast<int>(std::lround(camera.project({left ? -0.3 : 0.3, 0, 1.5}).x()));
        const int x = left ? edge - 1 - d : edge + 1 + d;
        count += depth.contains(x, y) && depth.at(x, y) <= 0.0F ? 1 : 0;
      }
    }
    return count;
  }
};

Sensed sense(SensorKind kind, SensorModel& sensor, std::uint64_t seed = 1) {
  Sensed s;
  s.camera = sensorCamera(kind);
  TriangleMesh scene = wall(4.0, 20.0);
  const TriangleMesh board = wall(1.5, 0.3);
  for (const Eigen::Vector3f& v : board.vertices) scene.vertices.push_back(v);
  scene.triangles.push_back({4, 5, 6});
  scene.triangles.push_back({4, 6, 7});
  DepthRenderer renderer;
  renderer.setBackground(scene);
  renderer.render(s.camera, uprightCamera(), sensor.renderOptions(), s.clean);
  Random random(seed);
  sensor.apply(s.clean, s.camera, random, s.depth, s.parts);
  return s;
}

Sensed sense(SensorKind kind) {
  SensorModel sensor(kind);
  return sense(kind, sensor);
}

TEST(NamedCamera, NamesAndKindsBelongTogether) {
  for (const NamedCamera& camera : namedCameras()) {
    EXPECT_EQ(namedCamera(camera.kind).name, camera.name);
    EXPECT_EQ(sensorNamed(camera.name), camera.kind);
  }
  EXPECT_EQ(sensorNamed("kinect3"), std::nullopt);
  EXPECT_EQ(sensorCamera(SensorKind::D435Hd).width, 1280);
  EXPECT_EQ(sensorCamera(SensorKind::D435Portrait).height, 640);
}

TEST(NamedCamera, EachMeasuresDeterministicallyAndInPlace) {
  for (const NamedCamera& named : namedCameras()) {
    const Sensed s = sense(named.kind);
    EXPECT_EQ(s.depth.data, sense(named.kind).depth.data) << named.name;
    EXPECT_EQ(s.depth.width, named.width);
    double sum = 0;
    int count = 0;
    for (int y = -10; y <= 10; ++y) {
      const float z = s.at(0.02 * y, 0.01 * y, 1.5);
      if (z <= 0) continue;
      sum += static_cast<double>(z);
      ++count;
    }
    ASSERT_GT(count, 5) << named.name;
    EXPECT_NEAR(sum / count, 1.5, 0.03) << named.name;
  }
}

TEST(NamedCamera, BaselineShadowIsOnTheLeft) {
  for (const SensorKind kind : {SensorKind::Kinect1, SensorKind::D435Raw, SensorKind::D435Hd, SensorKind::Orbbec}) {
    SensorModel sensor(kind);
    sensor.stereo.noise.dropout = 0;
    sensor.stereo.noise.edge_gap_px = 0;  // on both sides
    const Sensed s = sense(kind, sensor);
    EXPECT_GT(s.missing(true), 2 * s.missing(false) + 20) << sensorName(kind);
  }
}

TEST(NamedCamera, ShadowOfACameraOnItsSideIsAboveOrBelow) {
  SensorModel sensor(SensorKind::D435Portrait);
  sensor.stereo.noise.filling = HoleFilling::None;
  sensor.stereo.noise.smoothing_px = 0;
  sensor.stereo.noise.dropout = 0;
  const Sensed s = sense(SensorKind::D435Portrait, sensor);
  int above = 0;
  int beside = 0;
  for (int i = 0; i < 40; ++i) {
    const Eigen::Vector2d top = s.camera.project({0, -0.3, 1.5});
    const Eigen::Vector2d left = s.camera.project({-0.3, 0, 1.5});
    above += s.depth.at(static_cast<int>(top.x()), static_cast<int>(top.y()) - 1 - i) <= 0.0F ? 1 : 0;
    beside += s.depth.at(static_cast<int>(left.x()) - 1 - i, static_cast<int>(left.y())) <= 0.0F ? 1 : 0;
  }
  EXPECT_GT(above, beside + 4);
}

TEST(NamedCamera, FilledHolesAreRampsAndUnfilledOnesHoles) {
  const auto between = [](const Sensed& s) {  // pixels of the middle rows that are neither board nor wall
    int count = 0;
    for (int y = s.camera.height / 2 - 20; y < s.camera.height / 2 + 20; ++y) {
      for (int x = 0; x < s.camera.width; ++x) count += s.depth.at(x, y) > 1.9F && s.depth.at(x, y) < 3.2F ? 1 : 0;
    }
    return count / 40.0;  // a row
  };
  EXPECT_GT(between(sense(SensorKind::D435)), 8.0);
  EXPECT_LT(between(sense(SensorKind::D435Raw)), 1.0);
}

TEST(NamedCamera, WideHolesStay) {
  SensorModel sensor(SensorKind::D435);
  sensor.stereo.noise.fill_px = 4;
  EXPECT_GT(sense(SensorKind::D435, sensor).missing(true), sense(SensorKind::D435).missing(true) + 100);
}

TEST(NamedCamera, FarWallsOfStereoAreWavier) {
  const auto deviation = [](const Sensed& s, double x_m, double z_m) {
    double sum = 0;
    double squares = 0;
    int count = 0;
    for (int i = -15; i <= 15; ++i) {
      for (int k = -15; k <= 15; ++k) {
        const float z = s.at(x_m + 0.01 * i * z_m / 1.5, 0.01 * k * z_m / 1.5, z_m);
        if (z <= 0 || std::abs(z - z_m) > 0.5) continue;
        sum += z;
        squares += static_cast<double>(z) * z;
        ++count;
      }
    }
    return std::sqrt(squares / count - sum / count * (sum / count));
  };
  const Sensed s = sense(SensorKind::D435Hd);
  // Noise grows with the square of the distance: sevenfold from 1.5 to 4 m.
  EXPECT_GT(deviation(s, 1.9, 4.0), 3.0 * deviation(s, 0.0, 1.5));
}

TEST(NamedCamera, BlindBandOfStereo) {
  const Sensed s = sense(SensorKind::D435Raw);
  for (int y = 0; y < s.camera.height; ++y) {
    for (int x = 0; x < 4; ++x) ASSERT_EQ(s.depth.at(x, y), 0.0F);  // f B / z = 4.8 px
  }
}

TEST(NamedCamera, HexagonOfTheAzureKinect) {
  SensorModel sensor(SensorKind::Azure);
  sensor.tof.noise.max_depth_m = 10;
  const Sensed s = sense(SensorKind::Azure, sensor);
  const int w = s.camera.width;
  const int h = s.camera.height;
  for (const auto& [x, y] : {std::pair{5, 5}, std::pair{w - 6, 5}, std::pair{5, h - 6}, std::pair{w - 6, h - 6}}) {
    EXPECT_EQ(s.depth.at(x, y), 0.0F);
  }
  for (const auto& [x, y] :
       {std::pair{5, h / 2}, std::pair{w - 6, h / 2}, std::pair{w / 2, 5}, std::pair{w / 2, h - 6}}) {
    EXPECT_GT(s.depth.at(x, y), 0.0F);
  }
}

TEST(NamedCamera, FlyingPixelsOfTimeOfFlight) {
  SensorModel sensor(SensorKind::Azure);
  sensor.tof.noise.max_depth_m = 10;
  const Sensed s = sense(SensorKind::Azure, sensor);
  int flying = 0;
  for (const float z : s.depth.data) flying += z > 1.7F && z < 3.7F ? 1 : 0;
  EXPECT_GT(flying, 20);
  EXPECT_LT(flying, 1000);
}

// A right angle of two walls whose edge is 3 m away and vertical.
TEST(NamedCamera, MultipathRoundsCorners) {
  TriangleMesh corner;
  corner.vertices = {{0, -9, -3}, {-9, -9, 6}, {-9, 9, 6}, {0, 9, -3}, {9, -9, 6}, {9, 9, 6}};
  corner.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 3}};
  DepthRenderer renderer;
  renderer.setBackground(corner);
  SensorModel sensor(SensorKind::Azure);
  sensor.tof.noise.noise_m = sensor.tof.noise.noise_per_m2 = sensor.tof.noise.wiggle_m = 0;
  Sensed s;
  s.camera = sensorCamera(SensorKind::Azure);
  renderer.render(s.camera, uprightCamera(), sensor.renderOptions(), s.clean);
  Random random(1);
  sensor.apply(s.clean, s.camera, random, s.depth, s.parts);
  const auto error = [&](double x_m) {
    const Eigen::Vector2d uv = s.camera.project({x_m, 0, 3.0 - x_m});
    const auto x = static_cast<int>(std::lround(uv.x()));
    return static_cast<double>(s.depth.at(x, s.camera.height / 2) - s.clean.depth.at(x, s.camera.height / 2));
  };
  EXPECT_NEAR(error(0.005), 0.0, 0.004) << "in the corner";
  EXPECT_GT(error(0.1), 0.008) << "beside it";
  EXPECT_NEAR(error(0.6), 0.0, 0.002) << "far from it";
}

}  // namespace
}  // namespace depthmocap

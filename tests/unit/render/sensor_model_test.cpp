#include "forest/render/sensor_model.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/unit/render/test_meshes.h"

namespace depthmocap {
namespace {

using testing::ellipsoid;
using testing::setBody;
using testing::uprightCamera;
using testing::wall;

struct Sensed {
  RenderedView clean;
  DepthImage depth;
  PartImage parts;
  CameraModel camera;
};

Sensed senseWall(SensorModel& sensor, SensorKind kind, double distance_m, std::uint64_t seed = 1) {
  Sensed s;
  s.camera = sensorCamera(kind, true);
  DepthRenderer renderer;
  renderer.setBackground(wall(distance_m, 10.0));
  renderer.render(s.camera, uprightCamera(), sensor.renderOptions(), s.clean);
  Random random(seed);
  sensor.apply(s.clean, s.camera, random, s.depth, s.parts);
  return s;
}

Sensed senseBall(SensorKind kind, std::uint64_t seed) {
  Sensed s;
  s.camera = sensorCamera(kind, true);
  DepthRenderer renderer;
  SensorModel sensor(kind);
  setBody(renderer, ellipsoid({0.0, 0.0, -2.0}, {0.4, 0.6, 0.3}, 50, Part::Torso));
  renderer.render(s.camera, uprightCamera(), sensor.renderOptions(), s.clean);
  Random random(seed);
  sensor.apply(s.clean, s.camera, random, s.depth, s.parts);
  return s;
}

struct Statistics {
  double mean = 0;
  double deviation = 0;
  double measured = 0;  // share of the pixels
};

Statistics statisticsOf(const DepthImage& depth) {
  double sum = 0;
  double squares = 0;
  double count = 0;
  for (const float d : depth.data) {
    if (d <= 0.0F) continue;
    sum += d;
    squares += static_cast<double>(d) * d;
    ++count;
  }
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean)),
          count / static_cast<double>(depth.data.size())};
}

TEST(SensorModel, Kinect1DepthComesInDisparitySteps) {
  SensorModel sensor(SensorKind::Kinect1);
  sensor.kinect1.window_noise_px = 0.1;  // enough to visit several steps
  for (const double distance : {1.0, 2.0, 4.0}) {
    const Sensed s = senseWall(sensor, SensorKind::Kinect1, distance);
    std::set<float> levels(s.depth.data.begin(), s.depth.data.end());
    levels.erase(0.0F);
    ASSERT_GT(levels.size(), 1U);
    const double focal_baseline = 575.8 * 0.075;
    for (const float level : levels) {
      const double eighths = 8.0 * focal_baseline / level;
      const double tolerance_eighths = 8.0 * focal_baseline / (level * level) * 0.00051;  // stored in millimetres
      EXPECT_NEAR(eighths, std::round(eighths), tolerance_eighths) << level;
    }
    const double step = *std::next(levels.begin()) - *levels.begin();
    EXPECT_NEAR(step, distance * distance / (8.0 * focal_baseline), 0.15 * step + 0.001);
  }
}

TEST(SensorModel, Kinect1NoiseGrowsWithTheSquareOfDistance) {
  SensorModel sensor(SensorKind::Kinect1);
  const Statistics near = statisticsOf(senseWall(sensor, SensorKind::Kinect1, 1.0).depth);
  const Statistics far = statisticsOf(senseWall(sensor, SensorKind::Kinect1, 4.0).depth);
  EXPECT_NEAR(near.mean, 1.0, 0.002);
  EXPECT_NEAR(far.mean, 4.0, 0.02);
  EXPECT_GT(near.deviation, 0.0005);
  EXPECT_LT(near.deviation, 0.003);
  EXPECT_GT(far.deviation, 0.008);
  EXPECT_LT(far.deviation, 0.04);
  EXPECT_GT(near.measured, 0.98);
}

TEST(SensorModel, Kinect2NoiseIsMillimetres) {
  SensorModel sensor(SensorKind::Kinect2);
  const Statistics near = statisticsOf(senseWall(sensor, SensorKind::Kinect2, 1.0).depth);
  const Statistics far = statisticsOf(senseWall(sensor, SensorKind::Kinect2, 4.0).depth);
  EXPECT_NEAR(near.mean, 1.0, 0.004);
  EXPECT_LT(near.deviation, 0.006);
  EXPECT_GT(far.deviation, near.deviation * 1.2);
  EXPECT_LT(far.deviation, 0.015);
}

TEST(SensorModel, NothingIsMeasuredOutOfRange) {
  SensorModel kinect1(SensorKind::Kinect1);
  SensorModel kinect2(SensorKind::Kinect2);
  for (const float d : senseWall(kinect1, SensorKind::Kinect1, 0.4).depth.data) EXPECT_EQ(d, 0.0F);
  for (const float d : senseWall(kinect1, SensorKind::Kinect1, 9.0).depth.data) EXPECT_EQ(d, 0.0F);
  for (const float d : senseWall(kinect2, SensorKind::Kinect2, 5.0).depth.data) EXPECT_EQ(d, 0.0F);
}

TEST(SensorModel, PartsAgreeWithDepthAndSilhouetteHolds) {
  for (const SensorKind kind : {SensorKind::Kinect1, SensorKind::Kinect2}) {
    const Sensed s = senseBall(kind, 3);
    int clean = 0;
    int sensed = 0;
    int both = 0;
    for (std::size_t i = 0; i < s.depth.data.size(); ++i) {
      const bool in_clean = s.clean.parts.data[i] != 0;
      const bool in_sensed = s.parts.data[i] != 0;
      if (in_sensed) {
        EXPECT_GT(s.depth.data[i], 0.0F);
      }
      clean += in_clean ? 1 : 0;
      sensed += in_sensed ? 1 : 0;
      both += in_clean && in_sensed ? 1 : 0;
    }
    EXPECT_GT(clean, 3000);
    EXPECT_GT(both, 0.93 * clean) << sensorName(kind);
    EXPECT_LT(sensed - both, 0.03 * clean) << sensorName(kind);
    EXPECT_LT(both, clean) << "no pixel was lost: " << sensorName(kind);
  }
}

TEST(SensorModel, Kinect2FliesBehindSilhouettesOnly) {
  const Sensed s = senseBall(SensorKind::Kinect2, 5);
  int flying = 0;
  for (std::size_t i = 0; i < s.depth.data.size(); ++i) {
    if (s.depth.data[i] <= 0.0F || s.clean.depth.data[i] <= 0.0F) continue;
    EXPECT_GT(s.depth.data[i], s.clean.depth.data[i] - 0.1F);
    flying += s.depth.data[i] > s.clean.depth.data[i] + 0.05F ? 1 : 0;
  }
  EXPECT_GT(flying, 20);
  EXPECT_LT(flying, 400);
}

TEST(SensorModel, EqualSeedsGiveEqualPicturesAndOthersDiffer) {
  for (const SensorKind kind : {SensorKind::Kinect1, SensorKind::Kinect2}) {
    const Sensed a = senseBall(kind, 7);
    const Sensed b = senseBall(kind, 7);
    const Sensed c = senseBall(kind, 8);
    EXPECT_EQ(a.depth.data, b.depth.data);
    EXPECT_EQ(a.parts.data, b.parts.data);
    EXPECT_NE(a.depth.data, c.depth.data);
  }
}

TEST(SensorModel, ProjectorShadowIsNotMeasured) {
  Sensed s;
  s.camera = sensorCamera(SensorKind::Kinect1, true);
  DepthRenderer renderer;
  SensorModel sensor(SensorKind::Kinect1);
  renderer.setBackground(wall(3.0, 10.0));
  setBody(renderer, ellipsoid({0.0, 0.0, -1.5}, {0.25, 0.25, 0.25}, 40, Part::Torso));
  renderer.render(s.camera, uprightCamera(), sensor.renderOptions(), s.clean);
  Random random(2);
  sensor.apply(s.clean, s.camera, random, s.depth, s.parts);
  int shadow = 0;
  int measured = 0;
  for (std::size_t i = 0; i < s.depth.data.size(); ++i) {
    if (s.clean.depth.data[i] < 2.9F || s.clean.lit.data[i] != 0) continue;
    ++shadow;
    measured += s.depth.data[i] > 0.0F ? 1 : 0;
  }
  EXPECT_GT(shadow, 200);
  EXPECT_LT(measured, 0.25 * shadow);  // the wobble of silhouettes moves the border of the shadow
}

TEST(SensorModel, NamesAreFoundAgain) {
  EXPECT_EQ(sensorNamed("kinect1"), SensorKind::Kinect1);
  EXPECT_EQ(sensorNamed("kinect2"), SensorKind::Kinect2);
  EXPECT_FALSE(sensorNamed("kinect3"));
}

}  // namespace
}  // namespace depthmocap

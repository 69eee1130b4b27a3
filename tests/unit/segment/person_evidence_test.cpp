#include "libtracker/segment/person_evidence.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

constexpr double kPassedOn = 0.8187308;
constexpr double kGap_m = 0.1;

struct Scene {
  CoarseCloud cloud;
  RoomMap map;

  explicit Scene(std::uint64_t seed) {
    Random random(seed);
    cloud.stride = 4;
    cloud.offset = map.offset = 2;
    cloud.width = 12;
    cloud.height = 8;
    map.stride = 8;
    map.width = 6;
    map.height = 4;
    for (int i = 0; i < cloud.width * cloud.height; ++i) {
      const double z = random.uniform() < 0.15 ? 0.0 : 2.0 + 0.06 * random.normal();
      cloud.points.emplace_back(0.0F, 0.0F, static_cast<float>(z));
    }
    for (int i = 0; i < map.width * map.height; ++i) {
      map.person.push_back(static_cast<float>(2 * random.normal()));
      map.shell.push_back(0);
      map.measured.push_back(1);
    }
  }
};

double shareBetween(float a, float b) {
  if (!(a > 0 && b > 0)) return 0;
  const double step = std::abs(static_cast<double>(a - b)) / kGap_m;
  return step < 1 ? kPassedOn * (1 - step * step) : 0;
}

// Mean of a line weighted by the product of the shares on the way.
std::vector<double> smoothed(const std::vector<double>& values, const std::vector<float>& z) {
  std::vector<double> result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    double sum = values[i];
    double weight = 1;
    double share = 1;
    for (std::size_t j = i; j-- > 0;) {
      share *= shareBetween(z[j], z[j + 1]);
      sum += share * values[j];
      weight += share;
    }
    share = 1;
    for (std::size_t j = i + 1; j < values.size(); ++j) {
      share *= shareBetween(z[j - 1], z[j]);
      sum += share * values[j];
      weight += share;
    }
    result.push_back(sum / weight);
  }
  return result;
}

void smoothLines(const CoarseCloud& cloud, bool rows, std::vector<double>& odds) {
  const int lines = rows ? cloud.height : cloud.width;
  const int length = rows ? cloud.width : cloud.height;
  for (int line = 0; line < lines; ++line) {
    std::vector<double> values;
    std::vector<float> z;
    const auto at = [&](int k) { return rows ? cloud.index(k, line) : cloud.index(line, k); };
    for (int k = 0; k < length; ++k) {
      values.push_back(odds[at(k)]);
      z.push_back(cloud.points[at(k)].z());
    }
    const std::vector<double> mean = smoothed(values, z);
    for (int k = 0; k < length; ++k) odds[at(k)] = mean[static_cast<std::size_t>(k)];
  }
}

TEST(PersonEvidence, IsTheWeightedMeanAlongSurfaces) {
  const Scene scene(5);
  // With a map of one value the nearest cell does not matter: only the smoothing of what is known does.
  Scene even = scene;
  even.map.person.assign(even.map.person.size(), 1.0F);
  std::vector<Identity> known(scene.cloud.points.size(), kUnknown);
  known[40] = known[41] = known[53] = 1;
  std::vector<double> expected;
  for (std::size_t i = 0; i < known.size(); ++i) {
    const bool measured = scene.cloud.points[i].z() > 0;
    expected.push_back(measured ? 1.0 + (known[i] == 1 ? 1.5 : 0.0) : 0.0);
  }
  for (int round = 0; round < 2; ++round) {
    smoothLines(scene.cloud, true, expected);
    smoothLines(scene.cloud, false, expected);
  }
  PersonEvidence evidence;
  evidence.read(even.cloud, even.map, known);
  evidence.smooth(even.cloud, std::vector<std::uint8_t>(known.size(), 1), kGap_m);
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(evidence.odds()[i], expected[i], 1e-4) << i;
}

// Between two cells of the map, a cell takes the one at its own depth.
TEST(PersonEvidence, TakesTheCellOfTheMapAtItsDepth) {
  Scene scene(6);
  for (auto& p : scene.cloud.points) p.z() = 4.0F;
  for (const int y : {0, 1, 2}) {
    for (const int x : {0, 1}) scene.cloud.points[scene.cloud.index(x, y)].z() = 2.0F;
  }
  scene.map.person.assign(scene.map.person.size(), -2.0F);
  scene.map.person[0] = scene.map.person[static_cast<std::size_t>(scene.map.width)] = 2.0F;  // at (0, 0) and (0, 2)
  PersonEvidence evidence;
  evidence.read(scene.cloud, scene.map, std::vector<Identity>(scene.cloud.points.size(), kUnknown));
  evidence.smooth(scene.cloud, std::vector<std::uint8_t>(scene.cloud.points.size(), 1), kGap_m);
  EXPECT_NEAR(evidence.odds()[scene.cloud.index(1, 1)], 2.0, 1e-5) << "between (0, 0) and (2, 2)";
  EXPECT_NEAR(evidence.odds()[scene.cloud.index(2, 1)], -2.0, 1e-5);
}

// A foot stands on the floor without a step in depth; what the classifier says of the floor is not about the foot.
TEST(PersonEvidence, OfFeetIsNotThatOfTheFloor) {
  Scene scene(7);
  for (auto& p : scene.cloud.points) p.z() = 3.0F;
  scene.map.person.assign(scene.map.person.size(), -3.0F);
  for (int x = 0; x < scene.map.width; ++x) scene.map.person[static_cast<std::size_t>(x)] = 1.0F;
  std::vector<std::uint8_t> off_floor(scene.cloud.points.size(), 0);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < scene.cloud.width; ++x) off_floor[scene.cloud.index(x, y)] = 1;
  }
  const std::vector<Identity> nobody(scene.cloud.points.size(), kUnknown);
  PersonEvidence evidence;
  evidence.read(scene.cloud, scene.map, nobody);
  evidence.smooth(scene.cloud, std::vector<std::uint8_t>(off_floor.size(), 1), kGap_m);
  const float without = evidence.odds()[scene.cloud.index(5, 0)];
  evidence.read(scene.cloud, scene.map, nobody);
  evidence.smooth(scene.cloud, off_floor, kGap_m);
  EXPECT_LT(without, 0);
  EXPECT_NEAR(evidence.odds()[scene.cloud.index(5, 0)], 1.0, 1e-5);
}

}  // namespace
}  // namespace depthmocap

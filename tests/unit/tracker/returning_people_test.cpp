#include "libtracker/tracker/returning_people.h"

#include <cmath>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

const CameraModel kCamera{160, 120, 130, 130, 79.5, 59.5};
constexpr double kCameraHeight_m = 1.2;
constexpr double kDistance_m = 3.0;

// A frame in which boards of some heights stand for people, by place.
struct Scene {
  DepthImage depth{160, 120, 0.0F};
  Segmentation seen;
  ExpectedPeople expected;

  // `top_m` 0: nobody.
  Scene& add(double x_m, double top_m, bool is_known = false) {
    PersonRegion region;
    region.mask = MaskImage(160, 120, 0);
    for (int y = 0; y < 120 && top_m > 0; ++y) {
      for (int x = 0; x < 160; ++x) {
        const Eigen::Vector3d p = kCamera.unproject(x, y, kDistance_m);
        if (std::abs(p.x() - x_m) > 0.15 || kCameraHeight_m - p.y() > top_m || kCameraHeight_m - p.y() < 0.1) continue;
        region.mask.at(x, y) = 1;
        depth.at(x, y) = static_cast<float>(kDistance_m);
        ++region.pixel_count;
      }
    }
    region.centroid_camera = Eigen::Vector3d(x_m, 0, kDistance_m);
    if (expected.empty()) seen.people.clear();  // a Segmentation begins with one
    seen.people.push_back(region);
    expected.push_back(is_known ? std::optional(ExpectedActor{region.centroid_camera, 0}) : std::nullopt);
    seen.floor_camera = Eigen::Vector4d(0, -1, 0, kCameraHeight_m);
    return *this;
  }
};

// Three numbers; a tall person had the first one, on the left, and a short one the second.
ReturningPeople tallAndShortLeft() {
  ReturningPeople returning(3, kCamera);
  Scene scene;
  scene.add(-0.8, 1.85).add(0.8, 1.60).add(0, 0);
  for (int frame = 0; frame < 5; ++frame) {
    returning.observe(0, scene.seen, scene.depth);
    returning.observe(1, scene.seen, scene.depth);
  }
  return returning;
}

// The number of whoever is seen at the first place.
std::size_t numberOfFirst(ReturningPeople returning, const Scene& scene) {
  returning.assign(scene.expected, scene.seen, scene.depth);
  for (std::size_t number = 0; number < 3; ++number) {
    if (returning.placeOf(number) == 0) return number;
  }
  return 3;
}

TEST(ReturningPeople, GetTheirNumberByHeight) {
  EXPECT_EQ(numberOfFirst(tallAndShortLeft(), Scene().add(0.1, 1.61).add(0, 0).add(0, 0)), 1U);
  EXPECT_EQ(numberOfFirst(tallAndShortLeft(), Scene().add(0.1, 1.84).add(0, 0).add(0, 0)), 0U);
}

TEST(ReturningPeople, GetTheirNumberByPlaceWhereNoFloorTellsHeights) {
  Scene right;
  right.add(0.7, 1.7).add(0, 0).add(0, 0);
  right.seen.floor_camera.reset();
  EXPECT_EQ(numberOfFirst(tallAndShortLeft(), right), 1U);
}

TEST(ReturningPeople, StrangersGetANumberThatNobodyHad) {
  EXPECT_EQ(numberOfFirst(tallAndShortLeft(), Scene().add(0, 2.1).add(0, 0).add(0, 0)), 2U);
}

TEST(ReturningPeople, WhoIsThereKeepsTheNumber) {
  ReturningPeople returning = tallAndShortLeft();
  const Scene scene = Scene().add(0.6, 1.60).add(0.8, 1.60, true).add(0, 0);
  returning.assign(scene.expected, scene.seen, scene.depth);
  EXPECT_EQ(returning.placeOf(1), 1U);
  EXPECT_EQ(returning.placeOf(2), 0U) << "like the one who is still there: somebody new";
}

TEST(ReturningPeople, TwoWhoComeBackAtOnceGetBothNumbers) {
  ReturningPeople returning = tallAndShortLeft();
  const Scene scene = Scene().add(0.5, 1.60).add(-0.5, 1.85).add(0, 0);
  returning.assign(scene.expected, scene.seen, scene.depth);
  EXPECT_EQ(returning.placeOf(1), 0U);
  EXPECT_EQ(returning.placeOf(0), 1U);
  EXPECT_EQ(returning.placeOf(2), 2U);
}

TEST(ReturningPeople, AreNotRememberedAfterAReset) {
  ReturningPeople returning = tallAndShortLeft();
  returning.forget();
  EXPECT_EQ(numberOfFirst(returning, Scene().add(0.1, 1.61).add(0, 0).add(0, 0)), 0U);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/segment/segment.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "tests/unit/segment/test_scene.h"

namespace depthmocap {
namespace {

constexpr int kActor = 1;
constexpr int kOther = 2;
constexpr int kRoom = 3;
constexpr int kBoard = 9;
constexpr double kCameraHeight = 1.1;

const Eigen::Vector3d kFeet(0.1, kCameraHeight, 2.7);

void addRoom(TestScene& scene) {
  scene.noise = 0.0015;
  scene.addPlane(kRoom, {0, -1, 0, kCameraHeight});
  scene.addPlane(kRoom, {0, 0, -1, 4.5});
  scene.addPlane(kRoom, {1, 0, 0, 2.0});
}

Segmentation segmentOnce(const TestScene& scene) {
  Image<int> objects;
  const DepthImage depth = scene.render(&objects);
  Segmenter segmenter{SegmentConfig{}};
  Segmentation result;
  segmenter.segment(depth, scene.camera, mapOf(objects), {std::nullopt}, result);
  return result;
}

// Intersection over union of what is found for the actor in one picture and the actor.
double overlapOnce(const TestScene& scene) {
  Image<int> objects;
  scene.render(&objects);
  return overlap(segmentOnce(scene).actor().mask, objects, kActor);
}

TEST(Segment, RemovedBackgroundKeepsEveryPixelOfThePerson) {
  TestScene scene;
  scene.addPerson(kActor, kFeet);
  Image<int> objects;
  const DepthImage depth = scene.render(&objects);
  Segmenter segmenter{SegmentConfig{}};
  Segmentation result;
  segmenter.segment(depth, scene.camera, mapOf(objects), {std::nullopt}, result);
  EXPECT_GT(overlap(result.actor().mask, objects, kActor), 0.999);
  EXPECT_FALSE(result.floor_camera.has_value());
  EXPECT_FALSE(result.actor().touches_border);
  EXPECT_LT((result.actor().centroid_camera - Eigen::Vector3d(0.1, 0.1, 2.6)).norm(), 0.15);
}

// The background is removed; a board 1 m away ends beside the actor.
TestScene behindABoard(double board_width) {
  TestScene scene;
  scene.noise = 0.001;
  scene.addPerson(kActor, kFeet);
  scene.addPanel(kBoard, Eigen::Vector3d(-0.22 - 0.5 * board_width, 0, 1.0), 0.5 * board_width, 0.5);
  return scene;
}

TEST(Segment, ABoardBeforeThePersonIsNotThePersonWhereTheBackgroundIsRemoved) {
  const TestScene scene = behindABoard(0.4);
  Image<int> objects;
  scene.render(&objects);
  EXPECT_GT(overlap(segmentOnce(scene).actor().mask, objects, kActor), 0.9);
}

// The network of rooms is lost so before people behind a board in an otherwise empty picture.
TEST(Segment, APersonBehindABoardIsFoundThoughTheClassifierIsLostWhileItSeesTheBoard) {
  for (const double board_width : {0.4, 1.2}) {  // of 0.4 m, and of more than half of the picture
    TestScene scene = behindABoard(board_width);
    if (board_width > 1) scene.addPanel(kBoard, Eigen::Vector3d(0, 0.41, 1.0), 0.8, 0.28);
    Image<int> objects;
    const DepthImage depth = scene.render(&objects);
    const auto measured = std::ranges::count_if(depth.data, [](float z) { return z > 0; });
    EXPECT_EQ(2 * static_cast<std::size_t>(measured) > depth.data.size(), board_width > 1);
    Image<int> lost = objects;
    for (int& object : lost.data) object = object == kActor ? kBoard : object;
    int looks = 0;
    const auto look = [&, sure = mapOf(objects), unsure = mapOf(lost)](const DepthImage& seen) -> const RoomMap& {
      ++looks;
      return std::ranges::equal(seen.data, depth.data) ? unsure(seen) : sure(seen);
    };
    Segmenter segmenter{SegmentConfig{}};
    Segmentation result;
    for (int frame = 0; frame < 3; ++frame) segmenter.segment(depth, scene.camera, look, {std::nullopt}, result);
    EXPECT_GT(overlap(result.actor().mask, objects, kActor), 0.9) << board_width;
    EXPECT_EQ(looks, 1) << "from then on it is known that the background was removed";
  }
}

TEST(Segment, SpecklesAreDroppedAndThePixelCountIsOfTheMask) {
  TestScene scene;
  scene.addPerson(kActor, kFeet);
  Image<int> objects;
  DepthImage depth = scene.render(&objects);
  for (int i = 0; i < 40; ++i) depth.at(10 + (i * 15) % 600, 20 + i % 2) = 3.0F;
  Segmenter segmenter{SegmentConfig{}};
  Segmentation result;
  segmenter.segment(depth, scene.camera, mapOf(objects), {std::nullopt}, result);
  EXPECT_GT(overlap(result.actor().mask, objects, kActor), 0.999);
  int count = 0;
  for (const auto value : result.actor().mask.data) count += value;
  EXPECT_EQ(count, result.actor().pixel_count);
}

TEST(Segment, HandCutOffFromTheBodyBelongsToIt) {
  TestScene scene;
  scene.addPerson(kActor, kFeet);
  scene.addEllipsoid(kActor, kFeet + Eigen::Vector3d(0.3, -1.25, -0.55), {0.06, 0.08, 0.05});
  EXPECT_GT(overlapOnce(scene), 0.999);
}

TEST(Segment, LegBehindTheOtherBelongsToTheActorInARoom) {
  TestScene scene;
  addRoom(scene);
  const Eigen::Vector3d feet = kFeet;
  scene.addEllipsoid(kActor, feet + Eigen::Vector3d(0, -1.62, 0), {0.10, 0.13, 0.09});
  scene.addEllipsoid(kActor, feet + Eigen::Vector3d(0, -1.20, 0), {0.14, 0.45, 0.18});
  scene.addEllipsoid(kActor, feet + Eigen::Vector3d(0, -0.45, -0.1), {0.09, 0.46, 0.08});
  scene.addEllipsoid(kActor, feet + Eigen::Vector3d(0.18, -0.42, 0.3), {0.09, 0.36, 0.07});
  EXPECT_GT(overlapOnce(scene), 0.95);
}

// Somebody of whom a table's edge hides the knees.
TestScene behindATable() {
  TestScene scene;
  addRoom(scene);
  scene.addPerson(kActor, kFeet);
  scene.addPanel(kRoom, {kFeet.x(), kFeet.y() - 0.75, kFeet.z() - 0.6}, 0.8, 0.13);
  return scene;
}

TEST(Segment, LegsThatGoOnBelowATableBelongToTheActor) {
  const TestScene scene = behindATable();
  Image<int> objects;
  const DepthImage depth = scene.render(&objects);
  Segmenter segmenter{SegmentConfig{}};
  Segmentation result;
  std::optional<ExpectedActor> expected;
  for (int frame = 0; frame < 3; ++frame) {
    segmenter.segment(depth, scene.camera, mapOf(objects), {expected}, result);
    EXPECT_GT(overlap(result.actor().mask, objects, kActor), 0.95) << "frame " << frame;
    expected = ExpectedActor{.p_camera = result.actor().centroid_camera};
  }
}

// Seen through the gap below the table, at the depth of the actor but with the floor between both.
TEST(Segment, AThingBesideTheActorsLegsIsNoneOfThem) {
  TestScene scene = behindATable();
  scene.addEllipsoid(kOther, kFeet + Eigen::Vector3d(0.55, -0.25, 0.05), {0.10, 0.25, 0.10});
  EXPECT_GT(overlapOnce(scene), 0.95);
}

TEST(Segment, NearerOfTwoPeopleIsTheActor) {
  TestScene scene;
  scene.addPerson(kActor, kFeet);
  scene.addPerson(kOther, kFeet + Eigen::Vector3d(0.35, 0, 1.0));
  EXPECT_GT(overlapOnce(scene), 0.99);
}

TEST(Segment, PredictionSelectsTheOtherPerson) {
  TestScene scene;
  scene.addPerson(kActor, kFeet);
  scene.addPerson(kOther, kFeet + Eigen::Vector3d(0.8, 0, 0.9));
  Image<int> objects;
  const DepthImage depth = scene.render(&objects);
  const ExpectedActor expected{kFeet + Eigen::Vector3d(0.75, -0.9, 0.8)};
  Segmenter segmenter{SegmentConfig{}};
  Segmentation result;
  segmenter.segment(depth, scene.camera, mapOf(objects), {expected}, result);
  EXPECT_GT(overlap(result.actor().mask, objects, kOther), 0.99);
}

TEST(Segment, RoomIsRemovedAndTheFloorFound) {
  TestScene scene;
  addRoom(scene);
  scene.addPerson(kActor, kFeet);
  Image<int> objects;
  const DepthImage depth = scene.render(&objects);
  Segmenter segmenter{SegmentConfig{}};
  Segmentation result;
  segmenter.segment(depth, scene.camera, mapOf(objects), {std::nullopt}, result);
  EXPECT_GT(overlap(result.actor().mask, objects, kActor), 0.95);  // the soles lie within the floor's tolerance
  ASSERT_TRUE(result.floor_camera.has_value());
  EXPECT_LT((result.floor_camera->head<3>() - Eigen::Vector3d(0, -1, 0)).norm(), 0.01);
  EXPECT_NEAR(result.floor_camera->w(), kCameraHeight, 0.01);
}

TEST(Segment, FloorOfATiltedCamera) {
  TestScene scene;
  const double tilt = 0.3;
  const Eigen::Vector3d up(0, -std::cos(tilt), -std::sin(tilt));
  scene.noise = 0.0015;
  scene.addPlane(kRoom, {up.x(), up.y(), up.z(), 1.6});
  const Eigen::Vector3d on_axis(0, 0, 2.6);
  const Eigen::Vector3d feet = on_axis - (up.dot(on_axis) + 1.6) * up;
  scene.addPerson(kActor, feet, up);
  Image<int> objects;
  const DepthImage depth = scene.render(&objects);
  Segmenter segmenter{SegmentConfig{}};
  Segmentation result;
  segmenter.segment(depth, scene.camera, mapOf(objects), {std::nullopt}, result);
  ASSERT_TRUE(result.floor_camera.has_value());
  EXPECT_LT((result.floor_camera->head<3>() - up).norm(), 0.01);
  EXPECT_GT(overlap(result.actor().mask, objects, kActor), 0.93);
}

TEST(Segment, CupboardsAndTablesAreNotTheActor) {
  TestScene scene;
  addRoom(scene);
  scene.addPerson(kActor, kFeet + Eigen::Vector3d(0.4, 0, 0.6));
  scene.addPanel(kRoom, {-0.7, 0.2, 2.0}, 0.3, 0.88);  // a cupboard's door, nearer than the actor
  scene.addEllipsoid(kRoom, {1.3, kCameraHeight - 0.25, 2.2}, {0.3, 0.2, 0.3});  // a stool
  EXPECT_GT(overlapOnce(scene), 0.95);
}

TEST(Segment, EmptyRoomHasNoActor) {
  TestScene scene;
  addRoom(scene);
  EXPECT_EQ(segmentOnce(scene).actor().pixel_count, 0);
}

TEST(Segment, TableLegIsNoActor) {
  TestScene scene;
  addRoom(scene);
  scene.addPanel(kRoom, {-0.5, 0.5, 2.0}, 0.04, 0.5);
  EXPECT_EQ(segmentOnce(scene).actor().pixel_count, 0);
}

TEST(Segment, UnmeasuredImageGivesAnEmptyMask) {
  const TestScene scene;
  const Segmentation result = segmentOnce(scene);
  EXPECT_EQ(result.actor().pixel_count, 0);
  EXPECT_EQ(result.actor().mask.width, 640);
  EXPECT_EQ(result.actor().centroid_camera, Eigen::Vector3d::Zero());
}

TEST(Segment, ActorLeavingTheImageTouchesTheBorder) {
  TestScene scene;
  scene.addPerson(kActor, {0.0, 1.5, 1.3});
  const Segmentation result = segmentOnce(scene);
  EXPECT_TRUE(result.actor().touches_border);
  EXPECT_GT(result.actor().pixel_count, 10000);
}

TEST(Segment, LegsBeyondThePictureOrBehindSomethingAreCutBelow) {
  TestScene whole;
  whole.addPerson(kActor, kFeet);
  EXPECT_FALSE(segmentOnce(whole).actor().cut_below);
  TestScene near;
  near.addPerson(kActor, {0.0, 1.5, 1.3});
  EXPECT_TRUE(segmentOnce(near).actor().cut_below);
  TestScene behind;
  behind.addPerson(kActor, kFeet);
  behind.addPanel(kActor + 1, {0.0, kFeet.y() - 0.3, kFeet.z() - 0.5}, 0.6, 0.3);
  const Segmentation seen = segmentOnce(behind);
  EXPECT_TRUE(seen.actor().cut_below && seen.actor().covered);
}

TEST(Segment, MovedCameraIsNoticed) {
  TestScene before;
  addRoom(before);
  before.addPerson(kActor, kFeet);
  TestScene after;
  after.noise = 0.0015;
  after.addPlane(kRoom, {0, -1, 0, 1.5});
  after.addPlane(kRoom, {0, 0, -1, 4.2});
  after.addPerson(kActor, {0.1, 1.5, 2.6});
  Segmenter segmenter{SegmentConfig{}};
  Segmentation result;
  Image<int> objects;
  for (const TestScene* scene : {&before, &after}) {
    const DepthImage depth = scene->render(&objects);
    segmenter.segment(depth, scene->camera, mapOf(objects), {std::nullopt}, result);
  }
  ASSERT_TRUE(result.floor_camera.has_value());
  EXPECT_NEAR(result.floor_camera->w(), 1.5, 0.01);
}

TEST(Segment, SameFramesGiveTheSameMasks) {
  TestScene scene;
  addRoom(scene);
  scene.addPerson(kActor, kFeet);
  const Segmentation first = segmentOnce(scene);
  const Segmentation second = segmentOnce(scene);
  EXPECT_EQ(first.actor().mask.data, second.actor().mask.data);
  EXPECT_EQ(*first.floor_camera, *second.floor_camera);
}

TEST(Segment, OddImageSizesWork) {
  TestScene scene;
  scene.camera.width = 211;
  scene.camera.height = 157;
  scene.camera.fx = scene.camera.fy = 175.0;
  scene.camera.cx = 105.0;
  scene.camera.cy = 78.0;
  scene.addPerson(kActor, kFeet);
  Image<int> objects;
  const DepthImage depth = scene.render(&objects);
  Segmenter segmenter{SegmentConfig{}};
  Segmentation result;
  segmenter.segment(depth, scene.camera, mapOf(objects), {std::nullopt}, result);
  EXPECT_GT(overlap(result.actor().mask, objects, kActor), 0.995);
}

TEST(SegmentConfig, ErrorNamesFieldAndRule) {
  SegmentConfig config;
  config.max_depth_m = 0.1;
  try {
    Segmenter segmenter(config);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("max_depth_m must be above min_depth_m"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace depthmocap

#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "libtracker/segment/segment.h"
#include "tests/unit/segment/test_scene.h"

// Two people in a room, frame by frame: the mask stays on the actor.
namespace depthmocap {
namespace {

constexpr int kActor = 1;
constexpr int kOther = 2;
constexpr int kRoom = 3;
constexpr double kCameraHeight = 1.1;
constexpr double kFrame_s = 1.0 / 30.0;
const Eigen::Vector3d kFeet(0.0, kCameraHeight, 2.9);

// What a frame's mask holds.
struct Masked {
  int actor = 0;        // pixels of the actor in the mask
  int other = 0;        // pixels of the other one in it
  int actor_shown = 0;  // pixels of the actor in the picture
  Segmentation segmentation;
};

// Plays frames and expects the actor where the mask was last, as the tracker does.
class Following {
 public:
  Masked next(const std::optional<Eigen::Vector3d>& actor_feet, const std::optional<Eigen::Vector3d>& other_feet) {
    TestScene scene;
    scene.camera = {320, 240, 262.5, 262.5, 159.5, 119.5};
    scene.noise = 0.0015;
    scene.addPlane(kRoom, {0, -1, 0, kCameraHeight});
    scene.addPlane(kRoom, {0, 0, -1, 4.8});
    if (actor_feet) scene.addPerson(kActor, *actor_feet);
    if (other_feet) scene.addPerson(kOther, *other_feet);
    Image<int> objects;
    const DepthImage depth = scene.render(&objects);
    Masked masked;
    segmenter_.segment(depth, scene.camera, mapOf(objects), {expected_}, masked.segmentation);
    for (std::size_t i = 0; i < objects.data.size(); ++i) {
      const bool in = masked.segmentation.actor().mask.data[i] != 0;
      masked.actor_shown += objects.data[i] == kActor ? 1 : 0;
      masked.actor += in && objects.data[i] == kActor ? 1 : 0;
      masked.other += in && objects.data[i] == kOther ? 1 : 0;
    }
    const bool seen = masked.segmentation.actor().pixel_count > 0;
    if (seen) expected_ = {masked.segmentation.actor().centroid_camera, 0};
    if (expected_) expected_->unseen_s += kFrame_s;
    return masked;
  }
  void forget() { expected_.reset(); }

 private:
  Segmenter segmenter_{SegmentConfig{}};
  std::optional<ExpectedActor> expected_;
};

// Somebody walks past at `distance` behind the actor (negative: in front of them), from one side to the other.
class WalkingPast : public testing::TestWithParam<double> {};

TEST_P(WalkingPast, TheMaskStaysOnTheActor) {
  Following following;
  const double reach = 2.0;
  int hidden_frames = 0;
  for (double x = reach; x > -reach; x -= 0.045) {
    const Masked masked = following.next(kFeet, kFeet + Eigen::Vector3d(x, 0, GetParam()));
    EXPECT_LE(masked.other, 0.02 * masked.actor_shown + 60) << "at " << x;
    if (masked.actor_shown < 1500) ++hidden_frames;
    if (masked.actor_shown > 3500) {
      EXPECT_GT(masked.actor, 0.85 * masked.actor_shown) << "at " << x;
    }
    if (std::abs(x) > 1.2) {
      EXPECT_EQ(masked.segmentation.actor().visible_share, 1) << "at " << x;
    }
  }
  if (GetParam() < -0.5) {
    EXPECT_GT(hidden_frames, 3) << "the scene does not hide the actor";
  }
}

INSTANTIATE_TEST_SUITE_P(Following, WalkingPast, testing::Values(-1.2, -0.6, -0.35, 0.35, 0.6));

TEST(Following, ShouldersThatTouchStayApart) {
  Following following;
  following.next(kFeet, std::nullopt);
  for (double x = 1.2; x > 0.50; x -= 0.03) following.next(kFeet, kFeet + Eigen::Vector3d(x, 0, 0));
  for (int i = 0; i < 15; ++i) {
    const Masked masked = following.next(kFeet, kFeet + Eigen::Vector3d(0.50, 0, 0));
    EXPECT_GT(masked.actor, 0.95 * masked.actor_shown);
    EXPECT_LT(masked.other, 0.03 * masked.actor_shown);
  }
}

TEST(Following, WhoIsHiddenIsWaitedForAndKnownAgain) {
  Following following;
  following.next(kFeet, std::nullopt);
  for (double x = 1.2; x > 0; x -= 0.05) following.next(kFeet, kFeet + Eigen::Vector3d(x, 0, -1.2));
  for (int i = 0; i < 30; ++i) {
    const Masked masked = following.next(std::nullopt, kFeet + Eigen::Vector3d(0, 0, -1.2));
    EXPECT_EQ(masked.segmentation.actor().pixel_count, 0) << "the other one is not taken";
  }
  Masked back;
  for (double x = 0.2; x < 0.8; x += 0.05)
    back = following.next(kFeet + Eigen::Vector3d(x, 0, 0), kFeet + Eigen::Vector3d(0, 0, -1.2));
  EXPECT_GT(back.actor, 0.9 * back.actor_shown);
  EXPECT_EQ(back.other, 0);
}

TEST(Following, AfterTheActorIsForgottenWhoeverIsThereIsTheActor) {
  Following following;
  for (int i = 0; i < 5; ++i) following.next(kFeet, kFeet + Eigen::Vector3d(0.9, 0, 0.3));
  EXPECT_EQ(following.next(std::nullopt, kFeet + Eigen::Vector3d(0.9, 0, 0.3)).segmentation.actor().pixel_count, 0);
  following.forget();
  EXPECT_GT(following.next(std::nullopt, kFeet + Eigen::Vector3d(0.9, 0, 0.3)).other, 3000);
}

TEST(Following, WhoComesInAtTheSideIsNoPartOfTheActor) {
  Following following;
  const Eigen::Vector3d feet = kFeet + Eigen::Vector3d(1.0, 0, 0);
  for (double x = 2.4; x > 1.55; x -= 0.03) {
    const Masked masked = following.next(feet, kFeet + Eigen::Vector3d(x, 0, -0.25));
    EXPECT_GT(masked.actor, 0.9 * masked.actor_shown) << "at " << x;
    EXPECT_LT(masked.other, 100) << "at " << x;
  }
}

TEST(Following, SaysHowMuchOfTheActorIsSeen) {
  Following following;
  following.next(kFeet, std::nullopt);
  Masked masked;
  for (double x = 1.2; x > 0.12; x -= 0.05) masked = following.next(kFeet, kFeet + Eigen::Vector3d(x, 0, -1.0));
  ASSERT_GT(masked.actor, 500);
  EXPECT_LT(masked.segmentation.actor().visible_share, 0.8);
  EXPECT_GT(masked.segmentation.actor().visible_share, 0.1);
}

}  // namespace
}  // namespace depthmocap

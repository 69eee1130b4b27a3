#include <optional>

#include <gtest/gtest.h>

#include "libtracker/segment/segment.h"
#include "tests/unit/segment/test_scene.h"

// Several people are followed at the same time.
namespace depthmocap {
namespace {

constexpr int kFirst = 1;
constexpr int kSecond = 2;
constexpr int kRoom = 3;
constexpr double kCameraHeight = 1.1;
constexpr double kFrame_s = 1.0 / 30.0;
const Eigen::Vector3d kFeet(0.0, kCameraHeight, 2.9);

// Pixels of each person in the masks of each who is followed.
struct Shares {
  std::vector<int> of_first;
  std::vector<int> of_second;
  int first_shown = 0;
  int second_shown = 0;
};

class Crowd {
 public:
  explicit Crowd(std::size_t followed) : expected_(followed) {}

  Shares next(const std::optional<Eigen::Vector3d>& first_feet, const std::optional<Eigen::Vector3d>& second_feet) {
    TestScene scene;
    scene.camera = {320, 240, 262.5, 262.5, 159.5, 119.5};
    scene.noise = 0.0015;
    scene.addPlane(kRoom, {0, -1, 0, kCameraHeight});
    scene.addPlane(kRoom, {0, 0, -1, 4.8});
    if (first_feet) scene.addPerson(kFirst, *first_feet);
    if (second_feet) scene.addPerson(kSecond, *second_feet);
    Image<int> objects;
    const DepthImage depth = scene.render(&objects);
    segmenter_.segment(depth, scene.camera, mapOf(objects), expected_, seen_);
    Shares shares;
    for (std::size_t i = 0; i < objects.data.size(); ++i) {
      shares.first_shown += objects.data[i] == kFirst ? 1 : 0;
      shares.second_shown += objects.data[i] == kSecond ? 1 : 0;
    }
    for (std::size_t k = 0; k < seen_.people.size(); ++k) {
      const PersonRegion& person = seen_.people[k];
      shares.of_first.push_back(0);
      shares.of_second.push_back(0);
      for (std::size_t i = 0; i < objects.data.size(); ++i) {
        if (person.mask.data[i] == 0) continue;
        shares.of_first.back() += objects.data[i] == kFirst ? 1 : 0;
        shares.of_second.back() += objects.data[i] == kSecond ? 1 : 0;
      }
      if (person.pixel_count > 0) expected_[k] = {person.centroid_camera, 0};
      if (expected_[k]) expected_[k]->unseen_s += kFrame_s;
    }
    return shares;
  }
  void forget(std::size_t k) { expected_[k].reset(); }
  [[nodiscard]] bool everybodyElseIsNobody(std::size_t from) const {
    for (std::size_t k = from; k < seen_.people.size(); ++k) {
      if (seen_.people[k].pixel_count > 0) return false;
    }
    return true;
  }

 private:
  Segmenter segmenter_{SegmentConfig{}};
  ExpectedPeople expected_;
  Segmentation seen_;
};

TEST(People, EachHasAMaskAndNobodyIsThereTwice) {
  Crowd crowd(4);
  const Shares shares = crowd.next(kFeet, kFeet + Eigen::Vector3d(0.9, 0, 0.4));
  EXPECT_GT(shares.of_first[0], 0.95 * shares.first_shown);  // the nearer one is the plainest
  EXPECT_EQ(shares.of_second[0], 0);
  EXPECT_GT(shares.of_second[1], 0.95 * shares.second_shown);
  EXPECT_EQ(shares.of_first[1], 0);
  EXPECT_TRUE(crowd.everybodyElseIsNobody(2));
}

TEST(People, WhoTouchFromTheFirstFrameOnAreToldApart) {
  Crowd crowd(3);
  const Shares shares = crowd.next(kFeet, kFeet + Eigen::Vector3d(0.5, 0, 0.02));
  const std::size_t first = shares.of_first[0] > shares.of_first[1] ? 0 : 1;  // both are as plain
  const std::size_t second = 1 - first;
  EXPECT_GT(shares.of_first[first], 0.9 * shares.first_shown);
  EXPECT_LT(shares.of_second[first], 0.1 * shares.second_shown);
  EXPECT_GT(shares.of_second[second], 0.9 * shares.second_shown);
  EXPECT_TRUE(crowd.everybodyElseIsNobody(2));
}

TEST(People, WhoComesLaterGetsThePlaceThatIsFree) {
  Crowd crowd(2);
  crowd.next(kFeet, std::nullopt);
  const Shares shares = crowd.next(kFeet, kFeet + Eigen::Vector3d(-0.9, 0, -0.5));  // nearer than the first
  EXPECT_GT(shares.of_first[0], 0.95 * shares.first_shown);
  EXPECT_GT(shares.of_second[1], 0.95 * shares.second_shown);
}

class Crossing : public testing::TestWithParam<double> {};

TEST_P(Crossing, NobodyIsTakenForTheOther) {
  Crowd crowd(2);
  for (double x = 1.5; x > -1.5; x -= 0.045) {
    const Shares shares = crowd.next(kFeet, kFeet + Eigen::Vector3d(x, 0, GetParam()));
    EXPECT_LE(shares.of_second[0], 0.02 * shares.first_shown + 60) << "at " << x;
    EXPECT_LE(shares.of_first[1], 0.02 * shares.second_shown + 60) << "at " << x;
    if (std::abs(x) > 0.9 && std::abs(x) < 1.3) {  // apart, and whole in view
      EXPECT_GT(shares.of_first[0], 0.85 * shares.first_shown) << "at " << x;
      EXPECT_GT(shares.of_second[1], 0.85 * shares.second_shown) << "at " << x;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(People, Crossing, testing::Values(-0.8, -0.5, 0.5, 0.8));

// Who comes out from behind somebody, touching, is taken for a part of that one, until they are apart.
TEST(People, WhoStepAsideFromSomebodyAreSomebodyElse) {
  Crowd crowd(2);
  crowd.next(kFeet, std::nullopt);
  for (const double x : {0.25, 0.3, 0.35, 0.4, 0.45, 0.5, 0.55, 0.6, 0.65, 0.7, 0.75}) {
    crowd.next(kFeet, kFeet + Eigen::Vector3d(x, 0, 0.05));
  }
  const Shares shares = crowd.next(kFeet, kFeet + Eigen::Vector3d(0.8, 0, 0.05));
  EXPECT_GT(shares.of_first[0], 0.95 * shares.first_shown);
  EXPECT_EQ(shares.of_second[0], 0);
  EXPECT_GT(shares.of_second[1], 0.95 * shares.second_shown);
}

TEST(People, AFreePlaceIsForTheNext) {
  Crowd crowd(2);
  for (int i = 0; i < 3; ++i) crowd.next(kFeet, kFeet + Eigen::Vector3d(0.9, 0, 0.4));
  crowd.next(std::nullopt, kFeet + Eigen::Vector3d(0.9, 0, 0.4));
  crowd.forget(0);
  crowd.next(std::nullopt, kFeet + Eigen::Vector3d(0.9, 0, 0.4));
  const Shares shares = crowd.next(kFeet + Eigen::Vector3d(-0.5, 0, 0), kFeet + Eigen::Vector3d(0.9, 0, 0.4));
  EXPECT_GT(shares.of_first[0], 0.95 * shares.first_shown);
  EXPECT_GT(shares.of_second[1], 0.95 * shares.second_shown);
}

}  // namespace
}  // namespace depthmocap

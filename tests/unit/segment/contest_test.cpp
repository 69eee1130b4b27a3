#include "libtracker/segment/contest.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

// Somebody who stands upright 3 m away, with all joints on one vertical line, head up.
ExpectedActor standingAt(double x_m) {
  ExpectedActor expected;
  expected.joints_camera.emplace();
  for (int j = 0; j < kJointCount; ++j) expected.joints_camera->col(j) = Eigen::Vector3d(x_m, 0.05 * j - 0.5, 3.0);
  return expected;
}

CoarseCloud cloudOf(const std::vector<Eigen::Vector3f>& points) {
  CoarseCloud cloud;
  cloud.width = static_cast<int>(points.size());
  cloud.height = 1;
  cloud.points = points;
  return cloud;
}

TEST(Contest, SurfaceBetweenTwoBelongsToTheNearerBody) {
  const CoarseCloud cloud = cloudOf({{-0.2F, 0, 2.9F}, {0.2F, 0, 2.9F}, {0.0F, 0, 2.95F}, {0.2F, 0.1F, 2.95F}});
  std::vector<Identity> known = {2, 1, 1, kUnknown};  // memory has mixed them up
  settleContest(cloud, {standingAt(-0.22), standingAt(0.22)}, known);
  EXPECT_EQ(known[0], 1);
  EXPECT_EQ(known[1], 2);
  EXPECT_EQ(known[2], 1) << "as near to one as to the other: memory decides";
  EXPECT_EQ(known[3], 2) << "new surface";
}

TEST(Contest, LeavesOthersAndWhatIsFarFromBothAlone) {
  const CoarseCloud cloud = cloudOf({{-0.2F, 0, 2.9F}, {0.2F, 0, 2.5F}, {0.2F, 0, 0}});
  std::vector<Identity> known = {kSomebodyElse, 1, 1};
  const std::vector<Identity> before = known;
  settleContest(cloud, {standingAt(-0.22), standingAt(0.22)}, known);
  EXPECT_EQ(known, before);
}

TEST(Contest, NeedsTwoWhoAreNearEachOther) {
  const CoarseCloud cloud = cloudOf({{-0.2F, 0, 2.9F}});
  std::vector<Identity> known = {2};
  settleContest(cloud, {standingAt(-0.22), standingAt(1.2)}, known);
  settleContest(cloud, {standingAt(-0.22), std::nullopt}, known);
  settleContest(cloud, {standingAt(-0.22), ExpectedActor{}}, known);
  EXPECT_EQ(known[0], 2);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/ik/ik_files.h"

#include <gtest/gtest.h>

#include "libtracker/core/csv.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

std::string errorOfFile(const std::string& name) {
  return errorOf([&] { readTargetsFile(testData("ik") / (name + ".csv")); });
}

TEST(TargetsFile, ReadsTheGoldenFileByPose) {
  const auto poses = readTargetsFile(testData("ik/targets_good.csv"));
  ASSERT_EQ(poses.size(), 2U);
  EXPECT_EQ(poses[0].id, "1");
  EXPECT_EQ(poses[0].targets.count(), 3);
  EXPECT_TRUE(poses[0].targets.has(Joint::Pelvis));
  EXPECT_FALSE(poses[0].targets.has(Joint::Head));
  EXPECT_EQ(poses[0].targets.p_world.col(static_cast<int>(Joint::LeftWrist)), Eigen::Vector3d(0.5, 1.2, 0.3));
  EXPECT_EQ(poses[1].id, "reach_up");
  EXPECT_EQ(poses[1].targets.count(), 2);
}

TEST(TargetsFile, SaysFileLineAndReasonOfDamage) {
  const std::pair<const char*, const char*> cases[] = {
      {"targets_empty", "targets_empty.csv: is empty"},
      {"targets_none", "targets_none.csv: holds no target"},
      {"targets_wrong_columns", "line 1: column 5 'z' is missing"},
      {"targets_unknown_joint", "line 3: there is no such joint"},
      {"targets_twice", "line 4: joint 'head' is given twice"},
      {"targets_nan", "line 2: y must be a number"},
      {"targets_short_row", "line 2: has 4 fields"},
      {"targets_centimetres", "line 3: joints 'head' and 'left_wrist' are 55.9 m apart"},
      {"targets_millimetres", "line 2: a target more than 100 m"},
      {"targets_no_id", "line 2: pose_id is empty"}};
  for (const auto& [name, reason] : cases) {
    EXPECT_NE(errorOfFile(name).find(reason), std::string::npos) << errorOfFile(name);
  }
  EXPECT_NE(errorOfFile("targets_missing").find("cannot be read"), std::string::npos);
}

TEST(SolvedPoses, HaveTheJointsTheDofsAndTheResidual) {
  const TemporaryFolder folder;
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  const auto poses = readTargetsFile(testData("ik/targets_good.csv"));
  std::vector<IkResult> results(2);
  results[1].q[kRootTy] = 0.9;
  results[1].q[kLradiusRy] = -0.5;
  results[1].residual_m = 0.25;
  std::vector<SolvedPose> solved;
  for (std::size_t i = 0; i < 2; ++i) {
    solved.push_back({poses[i].id, poses[i].targets.given, results[i], static_cast<double>(i)});
  }
  writeSolvedPoses(solved, skeleton, folder / "p.csv");
  CsvReader csv(folder / "p.csv");
  std::vector<std::string> columns = {"pose_id", "time_s", "state"};
  for (const auto joint : kJointNames) {
    for (const char* suffix : {"_x", "_y", "_z", "_c"}) columns.push_back(std::string(joint) + suffix);
  }
  columns.insert(columns.end(), kDofNames.begin(), kDofNames.end());
  columns.emplace_back("residual_m");
  csv.readHeader(columns);
  ASSERT_TRUE(csv.next() && csv.next());
  EXPECT_EQ(csv.field(0), "reach_up");
  EXPECT_EQ(csv.number(1), 1);
  EXPECT_EQ(csv.field(2), "tracking");
  const JointPositions joints = jointPositions(skeleton, results[1].q);
  EXPECT_NEAR(csv.number(3 + 4 * 3 + 1), joints(1, 3), 1e-6);
  EXPECT_EQ(csv.number(3 + 4 * 3 + 3), 1);  // the head has a target
  EXPECT_EQ(csv.number(3 + 3), 0);          // the pelvis has none
  EXPECT_EQ(csv.number(3 + 4 * kJointCount + kLradiusRy), -0.5);
  EXPECT_EQ(csv.number(3 + 4 * kJointCount + kDofCount), 0.25);
  EXPECT_FALSE(csv.next());
}

}  // namespace
}  // namespace depthmocap

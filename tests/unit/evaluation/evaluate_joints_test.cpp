#include "libtracker/evaluation/evaluate_joints.h"

#include <cmath>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr auto kHead = static_cast<std::size_t>(Joint::Head);
constexpr auto kPelvis = static_cast<std::size_t>(Joint::Pelvis);

// Joint j at (j, 0, 2): every joint 1 m from the next.
JointsRow ruler(std::int64_t frame) {
  JointsRow row;
  row.frame = frame;
  row.time_s = 0.1 * static_cast<double>(frame);
  row.state = TrackState::Tracking;
  for (int joint = 0; joint < kJointCount; ++joint) row.p_camera.col(joint) = Eigen::Vector3d(joint, 0, 2);
  return row;
}

JointsRow lost(std::int64_t frame) {
  JointsRow row = ruler(frame);
  row.state = TrackState::Lost;
  return row;
}

JointsRow moved(JointsRow row, Joint joint, const Eigen::Vector3d& by) {
  row.p_camera.col(static_cast<int>(joint)) += by;
  return row;
}

TEST(EvaluateJoints, FindsNoErrorInTheTruthItself) {
  const std::vector<JointsRow> rows = {ruler(0), ruler(1), ruler(2)};
  const JointFigures figures = evaluateJoints(rows, rows, {});
  EXPECT_EQ(figures.frames, 3);
  EXPECT_EQ(figures.compared, 3);
  EXPECT_EQ(figures.mean_error_m, 0);
  EXPECT_EQ(figures.mean_hit_rate, 1);
  EXPECT_EQ(figures.mean_bone_direction_error_deg, 0);
  EXPECT_EQ(figures.jitter_m_s2, 0);
  EXPECT_EQ(figures.lost_fraction, 0);
}

// Head off by 5 cm in one frame (3-4-5) and by 20 cm in the other.
TEST(EvaluateJoints, MeansErrorsOverFramesAndJoints) {
  const std::vector<JointsRow> truth = {ruler(0), ruler(1)};
  const std::vector<JointsRow> tracked = {moved(ruler(0), Joint::Head, {0, 0.03, 0.04}),
                                          moved(ruler(1), Joint::Head, {0, 0, -0.2})};
  const JointFigures figures = evaluateJoints(tracked, truth, {});
  EXPECT_NEAR(figures.error_m[kHead], 0.125, 1e-12);
  EXPECT_EQ(figures.error_m[kPelvis], 0);
  EXPECT_NEAR(figures.mean_error_m, 0.125 / 18, 1e-12);
  EXPECT_EQ(figures.hit_rate[kHead], 0.5);
  EXPECT_NEAR(figures.mean_hit_rate, 17.5 / 18, 1e-12);
}

TEST(EvaluateJoints, CountsAFrameLostOrMissingAsAMissButNotAsAnError) {
  const std::vector<JointsRow> truth = {ruler(0), ruler(1), ruler(2), ruler(3)};
  JointsRow coasting = ruler(0);
  coasting.state = TrackState::Coasting;
  const JointFigures figures = evaluateJoints({coasting, lost(1), ruler(3)}, truth, {});
  EXPECT_EQ(figures.frames, 4);
  EXPECT_EQ(figures.compared, 2);
  EXPECT_EQ(figures.lost_fraction, 0.5);
  EXPECT_EQ(figures.mean_hit_rate, 0.5);
  EXPECT_EQ(figures.mean_error_m, 0);
}

TEST(EvaluateJoints, AsksOnlyForFramesWhoseTruthIsKnown) {
  const JointFigures figures = evaluateJoints({ruler(0), ruler(1), ruler(2)}, {ruler(0), lost(1)}, {});
  EXPECT_EQ(figures.frames, 1);
  EXPECT_EQ(figures.compared, 1);
}

TEST(EvaluateJoints, KeepsToTheRangeOfFrames) {
  const std::vector<JointsRow> truth = {ruler(0), ruler(1), ruler(2), ruler(3)};
  EvaluationOptions options;
  options.first = 1;
  options.last = 2;
  const JointFigures figures = evaluateJoints({ruler(1), ruler(2)}, truth, options);
  EXPECT_EQ(figures.frames, 2);
  EXPECT_EQ(figures.lost_fraction, 0);
}

TEST(EvaluateJoints, LeavesThePelvisOutWhenItIsTheOrigin) {
  JointsRow shifted = ruler(0);
  shifted.p_camera.colwise() += Eigen::Vector3d(1, 2, 3);
  EvaluationOptions options;
  options.root_relative = true;
  EXPECT_EQ(evaluateJoints({shifted}, {ruler(0)}, options).mean_error_m, 0);
  const JointFigures figures = evaluateJoints({moved(shifted, Joint::Head, {0.17, 0, 0})}, {ruler(0)}, options);
  EXPECT_NEAR(figures.mean_error_m, 0.17 / 17, 1e-12);
  EXPECT_NEAR(figures.mean_hit_rate, 16.0 / 17, 1e-12);
}

// The toe's bone is 1 m long; its end moved by 1 m at a right angle turns it by 45 degrees. It ends no other bone.
TEST(EvaluateJoints, MeasuresTheAngleOfABone) {
  const auto tracked = {moved(ruler(0), Joint::LeftToe, {0, 1, 0})};
  EXPECT_NEAR(evaluateJoints(tracked, {ruler(0)}, {}).mean_bone_direction_error_deg, 45.0 / 17, 1e-9);
}

TEST(EvaluateJoints, SkipsBonesWithoutLength) {
  const auto tracked = {moved(ruler(0), Joint::LeftToe, {-1, 0, 0})};
  EXPECT_EQ(evaluateJoints(tracked, {ruler(0)}, {}).mean_bone_direction_error_deg, 0);
}

// One joint at x = 0, 0, 0.01 m with 0.1 s steps: second difference 0.01 / 0.01 = 1 m/s^2, over 18 joints.
TEST(EvaluateJoints, MeasuresJitterBySecondDifferences) {
  const std::vector<JointsRow> truth = {ruler(0), ruler(1), ruler(2)};
  const std::vector<JointsRow> tracked = {ruler(0), ruler(1), moved(ruler(2), Joint::Head, {0, 0.01, 0})};
  const JointFigures figures = evaluateJoints(tracked, truth, {});
  EXPECT_NEAR(figures.jitter_m_s2, 1.0 / 18, 1e-9);
  EXPECT_NEAR(figures.truth_jitter_m_s2, 0, 1e-12);
}

// A steady 0.5 m/s is no acceleration, also across a dropped frame.
TEST(EvaluateJoints, KnowsSteadyMotionAcrossUnevenTimes) {
  std::vector<JointsRow> rows;
  for (const int frame : {0, 1, 3, 4}) rows.push_back(moved(ruler(frame), Joint::Head, {0.05 * frame, 0, 0}));
  EXPECT_NEAR(evaluateJoints(rows, rows, {}).jitter_m_s2, 0, 1e-9);
}

TEST(EvaluateJoints, TakesNoJitterAcrossLostFrames) {
  const std::vector<JointsRow> rows = {ruler(0), lost(1), moved(ruler(2), Joint::Head, {5, 0, 0}), ruler(3)};
  EXPECT_TRUE(std::isnan(evaluateJoints(rows, rows, {}).jitter_m_s2));
}

TEST(EvaluateJoints, HasNoFiguresWhenNothingCanBeCompared) {
  const JointFigures figures = evaluateJoints({}, {ruler(0)}, {});
  EXPECT_EQ(figures.frames, 1);
  EXPECT_EQ(figures.lost_fraction, 1);
  EXPECT_EQ(figures.mean_hit_rate, 0);
  EXPECT_TRUE(std::isnan(figures.mean_error_m));
  EXPECT_TRUE(std::isnan(evaluateJoints({}, {}, {}).lost_fraction));
}

}  // namespace
}  // namespace depthmocap

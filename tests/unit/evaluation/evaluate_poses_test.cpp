#include "libtracker/evaluation/evaluate_poses.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

PoseRow poseAt(std::int64_t frame, Dof dof, double value) {
  PoseRow row;
  row.frame = frame;
  row.q[dof] = value;
  return row;
}

TEST(EvaluatePoses, MeansTheAngleErrorOfEachDofOverFrames) {
  const std::vector<PoseRow> truth = {poseAt(0, kRradiusRy, 0), poseAt(1, kRradiusRy, 0)};
  const std::vector<PoseRow> tracked = {poseAt(0, kRradiusRy, 10 * kDegree), poseAt(1, kRradiusRy, -20 * kDegree)};
  const PoseFigures figures = evaluatePoses(tracked, truth, {});
  EXPECT_EQ(figures.compared, 2);
  EXPECT_NEAR(figures.error_deg[kRradiusRy], 15, 1e-9);
  EXPECT_EQ(figures.error_deg[kLradiusRy], 0);
  EXPECT_NEAR(figures.mean_angle_error_deg, 15.0 / 30, 1e-9) << "30 DoFs do not belong to the root";
}

TEST(EvaluatePoses, WrapsAngles) {
  const auto figures = evaluatePoses({poseAt(0, kHeadRy, 179 * kDegree)}, {poseAt(0, kHeadRy, -179 * kDegree)}, {});
  EXPECT_NEAR(figures.error_deg[kHeadRy], 2, 1e-9);
  const auto turns = evaluatePoses({poseAt(0, kHeadRy, 725 * kDegree)}, {poseAt(0, kHeadRy, 0)}, {});
  EXPECT_NEAR(turns.error_deg[kHeadRy], 5, 1e-9);
}

TEST(EvaluatePoses, KeepsTheRootOutOfTheMean) {
  const auto heading = evaluatePoses({poseAt(0, kRootRy, 1)}, {poseAt(0, kRootRy, 0)}, {});
  EXPECT_EQ(heading.mean_angle_error_deg, 0);
  EXPECT_NEAR(heading.error_deg[kRootRy], 1 / kDegree, 1e-9);
  const auto place = evaluatePoses({poseAt(0, kRootTz, 0.3)}, {poseAt(0, kRootTx, 0.4)}, {});
  EXPECT_NEAR(place.mean_root_position_error_m, 0.5, 1e-12);
  EXPECT_EQ(place.mean_angle_error_deg, 0);
}

TEST(EvaluatePoses, MatchesFramesByNumberWithinTheRange) {
  const std::vector<PoseRow> truth = {poseAt(0, kHeadRy, 0), poseAt(1, kHeadRy, 1), poseAt(2, kHeadRy, 2)};
  EvaluationOptions options;
  options.last = 1;
  const auto figures = evaluatePoses({poseAt(1, kHeadRy, 1), poseAt(2, kHeadRy, 9)}, truth, options);
  EXPECT_EQ(figures.compared, 1);
  EXPECT_EQ(figures.mean_angle_error_deg, 0);
}

TEST(EvaluatePoses, HasNoFiguresWithoutACommonFrame) {
  const auto figures = evaluatePoses({poseAt(1, kHeadRy, 1)}, {poseAt(2, kHeadRy, 1)}, {});
  EXPECT_EQ(figures.compared, 0);
  EXPECT_TRUE(std::isnan(figures.mean_angle_error_deg));
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/tracker/leave_out.h"

#include <gtest/gtest.h>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

TEST(LeaveOut, WithoutOursThePapersMethodIsLeft) {
  TrackerConfig config;
  for (const char* part : {"weights", "gaussian", "dense", "sides", "feet"}) leaveOut(part, config);
  const TrackerConfig paper = paperConfig();
  EXPECT_EQ(config.solve.lambda_prior, paper.solve.lambda_prior);
  EXPECT_EQ(config.prior.neighbours, paper.prior.neighbours);
  EXPECT_EQ(config.prior.residual_rad, paper.prior.residual_rad);
  EXPECT_EQ(config.solve.lambda_smooth, paper.solve.lambda_smooth);
  EXPECT_EQ(config.solve.velocity_share, paper.solve.velocity_share);
  EXPECT_EQ(config.policy.dense_rounds, paper.policy.dense_rounds);
  EXPECT_EQ(config.policy.expect_sides, paper.policy.expect_sides);
  EXPECT_EQ(config.policy.hold_feet, paper.policy.hold_feet);
}

TEST(LeaveOut, TheOrderDoesNotMatter) {
  TrackerConfig config;
  for (const char* part : {"prior", "weights"}) leaveOut(part, config);
  EXPECT_EQ(config.solve.lambda_prior, 0);
}

TEST(LeaveOut, EveryPartLeavesAValidConfiguration) {
  ASSERT_FALSE(optionalParts().empty());
  for (const std::string& part : optionalParts()) {
    TrackerConfig config;
    leaveOut(part, config);
    EXPECT_NO_THROW(config.validate()) << part;
  }
}

TEST(LeaveOut, AnUnknownPartIsRefusedByName) {
  TrackerConfig config;
  EXPECT_THROW(leaveOut("depth", config), Error);
}

}  // namespace
}  // namespace depthmocap

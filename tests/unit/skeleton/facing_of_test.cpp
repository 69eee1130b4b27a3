#include "libtracker/skeleton/facing_of.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr double kQuarter = std::numbers::pi / 2.0;

// Stands 2 m before the camera, turned by `heading`; 0 faces the camera.
Pose standing(double heading) {
  Pose q = Pose::Zero();
  q[kRootTz] = -2.0;
  q[kRootRy] = heading;
  return q;
}

TEST(FacingOf, NamesTheSideThatIsSeen) {
  EXPECT_EQ(facingOf(standing(0)), Facing::Front);
  EXPECT_EQ(facingOf(standing(2 * kQuarter)), Facing::Back);
  EXPECT_EQ(facingOf(standing(-2 * kQuarter)), Facing::Back);
  // A turn about the vertical by +90 degrees brings the face towards +x; the right side is then towards the camera.
  EXPECT_EQ(facingOf(standing(kQuarter)), Facing::Right);
  EXPECT_EQ(facingOf(standing(-kQuarter)), Facing::Left);
}

TEST(FacingOf, CountsFromTheDirectionToTheCamera) {
  Pose q = Pose::Zero();
  q[kRootTx] = 2.0;  // the camera is at the actor's right when the actor faces along its axis
  EXPECT_EQ(facingOf(q), Facing::Right);
  EXPECT_NEAR(cameraBearing(q), -kQuarter, 1e-12);
}

TEST(FacingOf, TurnsWithSmallMovesOnlyNearTheDiagonals) {
  EXPECT_EQ(facingOf(standing(0.49 * kQuarter)), Facing::Front);
  EXPECT_EQ(facingOf(standing(0.51 * kQuarter)), Facing::Right);
}

TEST(ExpectedFacing, PrefersThePosesSideAndRulesNothingOut) {
  const FacingShares shares = expectedFacing(standing(2 * kQuarter));
  for (std::size_t f = 0; f < kFacingCount; ++f) EXPECT_GT(shares[f], 0.0F);
  EXPECT_GT(shares[static_cast<std::size_t>(Facing::Back)], 5 * shares[static_cast<std::size_t>(Facing::Front)]);
}

}  // namespace
}  // namespace depthmocap

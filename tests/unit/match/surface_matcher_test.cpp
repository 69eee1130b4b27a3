#include "libtracker/match/surface_matcher.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr auto kArm = static_cast<std::size_t>(partIndex(Part::LeftLowerArm));
constexpr auto kLeg = static_cast<std::size_t>(partIndex(Part::LeftLowerLeg));

// An arm at x = 0 and a leg at x = 0.1 m, both 2 m away.
PlacedSurface armAndLeg() {
  PlacedSurface placed;
  for (const auto& [part, x] : {std::pair{kArm, 0.0F}, std::pair{kLeg, 0.1F}}) {
    const Eigen::Vector3f p(x, 0, -2);
    placed.parts[part].push_back({p, Eigen::Vector3f::UnitZ(), {}});
    placed.points.add(part, p);
  }
  placed.points.finish();
  return placed;
}

SurfaceSample sampleOf(std::size_t part, float x) {
  SurfaceSample sample;
  sample.p_world = {x, 0, -2};
  sample.probability[part] = 1;
  return sample;
}

TEST(SurfaceMatcher, TakesThePartThatTheClassifierSeesOrTheNearestOne) {
  const PlacedSurface placed = armAndLeg();
  SurfaceMatcher matcher({});
  SurfaceMatches matches;
  for (const Matching matching : {Matching::ByParts, Matching::ByDistance}) {
    matcher.observe({sampleOf(kLeg, 0.03F)}, matching);
    matcher.match(placed, matches);
    ASSERT_EQ(matches.size(), 1U);
    EXPECT_EQ(matches[0].part, matching == Matching::ByParts ? Part::LeftLowerLeg : Part::LeftLowerArm);
  }
}

TEST(SurfaceMatcher, SaysHowMuchABodyLeavesUnexplainedWhateverThePart) {
  const PlacedSurface placed = armAndLeg();
  SurfaceMatcher matcher({});
  EXPECT_EQ(matcher.unexplained(placed, 0.1), 0) << "nothing was observed";
  matcher.observe({sampleOf(kLeg, 0.0F)}, Matching::ByParts);
  EXPECT_NEAR(matcher.unexplained(placed, 0.1), 0, 1e-6);
  matcher.observe({sampleOf(kArm, 0.15F)}, Matching::ByParts);
  EXPECT_NEAR(matcher.unexplained(placed, 0.1), 0.25, 1e-4);
  matcher.observe({sampleOf(kArm, 0.0F), sampleOf(kArm, 0.9F)}, Matching::ByParts);
  EXPECT_NEAR(matcher.unexplained(placed, 0.1), 0.5, 1e-6) << "beyond its reach a point counts once";
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/match/part_points.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

constexpr PointLikelihood kLikelihood{0.04, 0.30};
constexpr double kMinProbability = 0.02;

Eigen::Vector3f randomPoint(Random& random) {
  return {static_cast<float>(random.uniform(-0.5, 0.5)), static_cast<float>(random.uniform(-0.9, 0.9)),
          static_cast<float>(random.uniform(-2.2, -2.0))};
}

std::array<float, kPartCount> randomShares(Random& random) {
  std::array<float, kPartCount> shares{};
  shares[random.below(kPartCount)] = static_cast<float>(random.uniform(0.3, 1.0));
  shares[random.below(kPartCount)] = static_cast<float>(random.uniform(0.0, 0.5));
  return shares;
}

using Points = std::array<std::vector<Eigen::Vector3f>, kPartCount>;

double costOf(const Points& points, const PartPoints::Found& found, const Eigen::Vector3f& p,
              const std::array<float, kPartCount>& shares) {
  const double square = static_cast<double>((points[found.part][found.index] - p).squaredNorm());
  return 0.5 * square / (0.04 * 0.04) - std::log(std::max(static_cast<double>(shares[found.part]), 0.02));
}

// The least cost of all points in reach; infinite if there is none.
double leastCost(const Points& points, const Eigen::Vector3f& p, const std::array<float, kPartCount>& shares) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t part = 0; part < kPartCount; ++part) {
    for (std::size_t i = 0; i < points[part].size(); ++i) {
      if ((points[part][i] - p).norm() <= 0.30F) least = std::min(least, costOf(points, {part, i}, p, shares));
    }
  }
  return least;
}

TEST(PartPoints, FindsWhatLookingAtEachPointFinds) {
  Random random(1);
  PartPoints search;
  for (int round = 0; round < 5; ++round) {
    Points points;
    search.clear();
    for (std::size_t part = 0; part < kPartCount; ++part) {
      const int count = part == 3 ? 0 : static_cast<int>(random.below(70));
      for (int i = 0; i < count; ++i) {
        points[part].push_back(randomPoint(random));
        search.add(part, points[part].back());
      }
    }
    search.finish();
    int found_count = 0;
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3f p = randomPoint(random);
      const auto shares = randomShares(random);
      const auto found = search.find(p, PartDoubts(shares, kMinProbability), kLikelihood);
      const double least = leastCost(points, p, shares);
      ASSERT_EQ(found.has_value(), std::isfinite(least));
      if (!found) continue;
      ++found_count;
      EXPECT_NEAR(costOf(points, *found, p, shares), least, 1e-4);
    }
    EXPECT_GT(found_count, 300);
  }
}

TEST(PartPoints, FindsNothingOutOfReachAndNothingAmongNothing) {
  PartPoints search;
  search.clear();
  search.finish();
  const PartDoubts doubts({}, kMinProbability);
  EXPECT_FALSE(search.find({0, 0, 0}, doubts, kLikelihood));
  search.clear();
  search.add(2, {0, 0, 1});
  search.finish();
  EXPECT_FALSE(search.find({0, 0, 0.6F}, doubts, kLikelihood));
  const auto found = search.find({0, 0, 0.8F}, doubts, kLikelihood);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->part, 2U);
  EXPECT_EQ(found->index, 0U);
}

TEST(PartDoubts, RiseFromTheLikeliestPart) {
  std::array<float, kPartCount> shares{};
  shares[5] = 0.7F;
  shares[2] = 0.3F;
  const PartDoubts doubts(shares, 0.02);
  EXPECT_EQ(doubts.part[0], 5);
  EXPECT_EQ(doubts.part[1], 2);
  EXPECT_FLOAT_EQ(doubts.doubt[0], -std::log(0.7F));
  EXPECT_FLOAT_EQ(doubts.doubt.back(), -std::log(0.02F));
}

}  // namespace
}  // namespace depthmocap

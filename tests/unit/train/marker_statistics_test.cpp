#include "forest/train/marker_statistics.h"

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"

namespace depthmocap {
namespace {

MarkerStatistics measure(const Forest* forest) {
  const std::vector<BodySurface> bodies{makeBuiltinBody(BodyShape{})};
  const std::vector<Eigen::Matrix<float, kDofCount, 1>> poses(1, Eigen::Matrix<float, kDofCount, 1>::Zero());
  MarkerStatisticsConfig config;
  config.images = 12;
  config.view.min_distance_m = 2;
  config.view.max_distance_m = 3;
  config.view.cut_share = 0;
  return measureMarkers(bodies, poses, forest, config);
}

TEST(MarkerStatistics, TrueLabelsGiveMarkersThatLieWell) {
  const MarkerStatistics statistics = measure(nullptr);
  int counted = 0;
  for (const auto& part : statistics.parts) {
    EXPECT_GT(part.seen, 0);
    EXPECT_EQ(part.missing, 0);
    EXPECT_LT(part.median_m, 0.06);
    EXPECT_LE(part.median_m, part.p95_m);
    counted += part.count;
  }
  int binned = 0;
  for (const auto& bin : statistics.by_confidence) {
    binned += bin.count;
    EXPECT_GE(bin.within, 0.0);
    EXPECT_LE(bin.within, 1.0);
  }
  EXPECT_EQ(binned, counted);
}

TEST(MarkerStatistics, PartsThatTheForestNeverNamesAreMissing) {
  Forest forest;
  forest.trees.resize(1);
  forest.trees[0].nodes.resize(1);
  forest.trees[0].leaves.resize(1);
  forest.trees[0].leaves[0][static_cast<std::size_t>(partIndex(Part::Torso))] = 255;
  const MarkerStatistics statistics = measure(&forest);
  for (int part = 0; part < kPartCount; ++part) {
    const auto& p = statistics.parts[static_cast<std::size_t>(part)];
    EXPECT_EQ(p.missing, partAt(part) == Part::Torso ? 0 : p.seen);
  }
}

}  // namespace
}  // namespace depthmocap

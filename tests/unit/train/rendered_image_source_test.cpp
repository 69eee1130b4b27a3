#include "forest/train/rendered_image_source.h"

#include <array>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

RenderedImageOptions tPoses(std::size_t count) {
  RenderedImageOptions options;
  options.count = count;
  options.t_poses = true;
  return options;
}

TEST(RenderedImageSource, ImagesDependOnTheirNumberAloneWhateverTheThreads) {
  const auto bodies = std::make_shared<const std::vector<BodySurface>>(makeBodyPool({1, "", 3}, 1));
  const auto none = std::make_shared<const PosePool>();
  RenderedImageSource source(bodies, none, tPoses(6));
  std::vector<TrainingImage> first(6), again(6);
  parallelFor(2, 6, [&](std::size_t i) { source.render(i, first[i]); });
  for (std::size_t i = 6; i-- > 0;) source.render(i, again[i]);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(first[i].depth.data, again[i].depth.data);
    EXPECT_EQ(first[i].labels.data, again[i].labels.data);
    std::size_t labelled = 0;
    for (std::size_t p = 0; p < first[i].depth.data.size(); ++p) {
      labelled += first[i].labels.data[p] != 0 ? 1 : 0;
      ASSERT_EQ(first[i].depth.data[p] > 0, first[i].labels.data[p] != 0);
    }
    EXPECT_GT(labelled, 500U);
    EXPECT_GT(first[i].focal_px, 100);
    EXPECT_EQ(first[i].facing, Facing::Front);
  }
  EXPECT_NE(first[0].depth.data, first[1].depth.data);
}

// With the left arm stretched out: seen from the front it lies to the right of the trunk in the image.
TEST(RenderedImageSource, FacingSaysFromWhereTheActorIsSeen) {
  const auto bodies = std::make_shared<const std::vector<BodySurface>>(makeBodyPool({1, "", 3}, 1));
  auto poses = std::make_shared<PosePool>();
  poses->poses.push_back(PosePool::StoredPose::Zero());
  RenderedImageOptions options;
  options.count = 40;
  options.variation = {0, 0};
  options.view.facing_share = 0;
  options.view.cut_share = 0;
  options.view.min_distance_m = 3;
  RenderedImageSource source(bodies, poses, options);
  std::array<int, kFacingCount> seen{};
  for (std::size_t i = 0; i < options.count; ++i) {
    TrainingImage image;
    source.render(i, image);
    double left = 0, right = 0, left_count = 0, right_count = 0;
    for (int y = 0; y < image.labels.height; ++y) {
      for (int x = 0; x < image.labels.width; ++x) {
        const auto part = static_cast<Part>(image.labels.at(x, y));
        if (part == Part::LeftLowerArm) {
          left += x;
          ++left_count;
        }
        if (part == Part::RightLowerArm) {
          right += x;
          ++right_count;
        }
      }
    }
    ASSERT_TRUE(image.facing);
    ++seen[static_cast<std::size_t>(*image.facing)];
    if (*image.facing == Facing::Left) {
      EXPECT_GT(left_count, right_count);
    }
    if (*image.facing == Facing::Right) {
      EXPECT_GT(right_count, left_count);
    }
    if (left_count == 0 || right_count == 0) continue;
    if (*image.facing == Facing::Front) {
      EXPECT_GT(left / left_count, right / right_count);
    }
    if (*image.facing == Facing::Back) {
      EXPECT_LT(left / left_count, right / right_count);
    }
  }
  for (const int n : seen) EXPECT_GT(n, 2);
}

TEST(RenderedImageSource, NoPosesAreAnError) {
  const auto bodies = std::make_shared<const std::vector<BodySurface>>(makeBodyPool({1, "", 3}, 1));
  EXPECT_THROW(RenderedImageSource(bodies, std::make_shared<const PosePool>(), {}), Error);
  EXPECT_THROW(makeBodyPool({0, "", 1}, 1), Error);
  EXPECT_THROW(makeBodyPool({1, "/nowhere", 1}, 1), Error);
}

}  // namespace
}  // namespace depthmocap

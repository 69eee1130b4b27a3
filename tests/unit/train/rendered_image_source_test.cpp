#include "forest/train/rendered_image_source.h"

#include <gtest/gtest.h>

#include "libtracker/core/error.h"
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
  }
  EXPECT_NE(first[0].depth.data, first[1].depth.data);
}

TEST(RenderedImageSource, NoPosesAreAnError) {
  const auto bodies = std::make_shared<const std::vector<BodySurface>>(makeBodyPool({1, "", 3}, 1));
  EXPECT_THROW(RenderedImageSource(bodies, std::make_shared<const PosePool>(), {}), Error);
  EXPECT_THROW(makeBodyPool({0, "", 1}, 1), Error);
  EXPECT_THROW(makeBodyPool({1, "/nowhere", 1}, 1), Error);
}

}  // namespace
}  // namespace depthmocap

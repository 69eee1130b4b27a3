#include "forest/train/image_store.h"

#include <array>

#include <gtest/gtest.h>

#include "forest/train/crop_probe.h"
#include "forest/train/training_samples.h"
#include "libtracker/classify/forest.h"
#include "tests/unit/train/disc_figures.h"

namespace depthmocap {
namespace {

TEST(MirrorImage, SwapsColumnsAndSidesAndIsItsOwnInverse) {
  test::DiscFigures source(1, 4);
  TrainingImage image;
  source.render(0, image);
  TrainingImage mirror = image;
  mirrorImage(mirror);
  for (int y = 0; y < image.depth.height; ++y) {
    for (int x = 0; x < image.depth.width; ++x) {
      const int opposite = image.depth.width - 1 - x;
      ASSERT_EQ(mirror.depth.at(opposite, y), image.depth.at(x, y));
      const auto label = image.labels.at(x, y);
      const auto expected = label == 0 ? label : static_cast<std::uint8_t>(mirrored(static_cast<Part>(label)));
      ASSERT_EQ(mirror.labels.at(opposite, y), expected);
    }
  }
  mirrorImage(mirror);
  EXPECT_EQ(mirror.depth.data, image.depth.data);
  EXPECT_EQ(mirror.labels.data, image.labels.data);
}

TEST(ImageCrop, ProbesReadWhatTheClassifierReads) {
  test::DiscFigures source(1, 8);
  TrainingImage image;
  source.render(0, image);
  ImageCrop crop;
  cropTrainingImage(image, crop);
  MaskImage mask(image.depth.width, image.depth.height, 0);
  for (std::size_t i = 0; i < mask.data.size(); ++i) mask.data[i] = image.depth.data[i] > 0 ? 1 : 0;
  ActorDepth actor;
  cutOutActor(image.depth, mask, actor);
  ASSERT_EQ(crop.width, actor.width);
  ASSERT_EQ(crop.height, actor.height);
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const int x = static_cast<int>(random.below(400)) - 100;
    const int y = static_cast<int>(random.below(400)) - 100;
    ASSERT_NEAR(probeCrop_mm(crop, x, y, 0.0F, {}), 1000 * actor.probe(x, y), 0.501);
  }
}

TEST(ImageCrop, ProbesOfAPixelTogetherEqualThoseOneByOne) {
  test::DiscFigures source(1, 8);
  TrainingImage image;
  source.render(0, image);
  ImageCrop crop;
  cropTrainingImage(image, crop);
  Random random(2);
  FeatureOptions options;
  options.offsets = 61;
  options.max_offset = 600;
  const auto offsets = drawOffsets(options, random);
  std::vector<std::uint16_t> together(offsets.size());
  for (int y = 1; y <= crop.height; y += 3) {
    for (int x = 1; x <= crop.width; ++x) {
      readProbesOfPixel(crop, x, y, offsets, together.data());
      for (std::size_t i = 0; i < offsets.size(); ++i) {
        ASSERT_EQ(together[i], probeCrop_mm(crop, x, y, probeScaleAt(crop, x, y), offsets[i]));
      }
    }
  }
}

TEST(ImageCrop, EmptyImageHasNoSamples) {
  TrainingImage image{DepthImage(20, 10, 0), PartImage(20, 10, 0), 100, {}};
  ImageCrop crop;
  cropTrainingImage(image, crop);
  EXPECT_EQ(crop.width, 0);
  EXPECT_EQ(probeCrop_mm(crop, 3, -2, 1.0F, {5, 5}), kBackgroundDepth_mm);
}

TEST(ImageStore, MirrorsAboutHalfOfTheImages) {
  test::DiscFigures source(64, 4);
  ImageStore store(source, {}, 9, std::size_t{1} << 30U, 2, [](double) {});
  EXPECT_EQ(store.cachedCount(), 64U);
  int mirrored_count = 0;
  ImageCrop scratch;
  for (std::size_t i = 0; i < store.count(); ++i) {
    TrainingImage image;
    source.render(i, image);
    ImageCrop plain;
    cropTrainingImage(image, plain);
    if (store.get(i, scratch).labels != plain.labels) ++mirrored_count;
  }
  EXPECT_GT(mirrored_count, 18);
  EXPECT_LT(mirrored_count, 46);
}

TEST(ImageStore, SharesTogetherAreAllImages) {
  test::DiscFigures source(7, 4);
  const auto make = [&](const ImageShare& share) { return ImageStore(source, share, 9, 0, 1, [](double) {}); };
  ImageStore whole = make({});
  std::size_t count = 0;
  ImageCrop scratch, other;
  for (int rank = 0; rank < 3; ++rank) {
    ImageStore share = make({rank, 3});
    ASSERT_EQ(share.first(), count);
    for (std::size_t i = 0; i < share.count(); ++i) {
      EXPECT_EQ(share.get(i, scratch).depth_mm, whole.get(count + i, other).depth_mm);
    }
    count += share.count();
  }
  EXPECT_EQ(count, 7U);
}

TEST(TrainingSamples, SmallPartsAreDrawnMoreOftenThanTheirShare) {
  test::DiscFigures source(30, 4);
  ImageStore store(source, {}, 9, std::size_t{1} << 30U, 1, [](double) {});
  const TrainingSamples samples = drawSamples(store, 100, 5, 2);
  ASSERT_EQ(samples.size(), 3000U);
  ASSERT_EQ(samples.first.size(), 31U);
  std::array<int, kPartCount> drawn{};
  ImageCrop scratch;
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const auto& sample = samples.samples[s];
    const ImageCrop& crop = store.get(samples.image[s], scratch);
    ASSERT_EQ(crop.labels[static_cast<std::size_t>((sample.y - 1) * crop.width + sample.x - 1)], sample.part_index + 1);
    ++drawn[sample.part_index];
  }
  for (const int n : drawn) EXPECT_GT(n, 100);  // half of the 3000 are spread evenly over 15 parts
}

}  // namespace
}  // namespace depthmocap

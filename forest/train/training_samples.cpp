#include "forest/train/training_samples.h"

#include <array>

#include "depthmocap/parts.h"
#include "libtracker/core/check.h"
#include "libtracker/core/parallel.h"
#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

constexpr std::uint64_t kSampleStream = 0x5341;

using Sample = TrainingSamples::Sample;

std::vector<Sample> drawFromImage(const ImageCrop& crop, std::uint32_t count, Random random) {
  std::array<std::vector<Sample>, kPartCount> of_part;
  std::vector<Sample> all;
  std::size_t at = 0;
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x, ++at) {
      const std::uint8_t label = crop.labels[at];
      if (label == 0) continue;
      DMC_CHECK(label <= kPartCount);
      const Sample sample{static_cast<std::int16_t>(x + 1), static_cast<std::int16_t>(y + 1),
                          static_cast<std::uint8_t>(label - 1)};
      all.push_back(sample);
      of_part[sample.part_index].push_back(sample);
    }
  }
  if (all.empty()) return {};
  std::vector<std::size_t> seen;
  for (std::size_t part = 0; part < kPartCount; ++part) {
    if (!of_part[part].empty()) seen.push_back(part);
  }
  const auto anyOf = [&](const std::vector<Sample>& from) {
    return from[random.below(static_cast<std::uint32_t>(from.size()))];
  };
  std::vector<Sample> drawn(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    drawn[i] = i % 2 == 0 ? anyOf(all) : anyOf(of_part[seen[random.below(static_cast<std::uint32_t>(seen.size()))]]);
  }
  return drawn;
}

}  // namespace

TrainingSamples drawSamples(ImageStore& images, std::uint32_t pixels_per_image, std::uint64_t seed, int threads) {
  std::vector<std::vector<Sample>> drawn(images.count());
  TrainingSamples result;
  result.facing.resize(images.count());
  parallelFor(threads, images.count(), [&](std::size_t i) {
    ImageCrop scratch;
    const ImageCrop& crop = images.get(i, scratch);
    result.facing[i] = crop.facing;
    drawn[i] = drawFromImage(crop, pixels_per_image, Random(seed + images.first() + i, kSampleStream));
  });
  result.first.push_back(0);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    result.samples.insert(result.samples.end(), drawn[i].begin(), drawn[i].end());
    result.image.insert(result.image.end(), drawn[i].size(), static_cast<std::uint32_t>(i));
    result.first.push_back(static_cast<std::uint32_t>(result.samples.size()));
    drawn[i] = {};
  }
  return result;
}

}  // namespace depthmocap

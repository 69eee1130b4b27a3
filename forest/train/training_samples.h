#pragma once
#include <cstdint>
#include <vector>

#include "forest/train/image_store.h"
#include "forest/train/split_search.h"

namespace depthmocap {

// The pixels that one tree learns from, image after image.
struct TrainingSamples {
  struct Sample {
    std::int16_t x = 0;  // [px] in the crop with its border
    std::int16_t y = 0;  // [px]
    std::uint8_t part_index = 0;
  };
  std::vector<Sample> samples;
  std::vector<std::uint32_t> first;  // of each image, and one past the last
  std::vector<std::uint32_t> image;  // of each sample
  std::vector<Facing> facing;        // of each image

  [[nodiscard]] std::uint8_t classOf(std::uint32_t sample) const {
    return classIndex(facing[image[sample]], samples[sample].part_index);
  }
  [[nodiscard]] std::size_t size() const { return samples.size(); }
};

// Draws `pixels_per_image` labelled pixels of every image, with replacement: half of them uniformly, half of them from
// a part chosen uniformly among those that are seen, so that small parts are learnt as well as large ones.
TrainingSamples drawSamples(ImageStore& images, std::uint32_t pixels_per_image, std::uint64_t seed, int threads);

}  // namespace depthmocap

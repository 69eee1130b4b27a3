#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "forest/train/training_image.h"

namespace depthmocap {

inline constexpr std::uint16_t kBackgroundDepth_mm = 10000;  // kBackgroundDepth_m

// The actor of one training image: depth in whole millimetres with a border of background one pixel wide (as
// ActorDepth), and labels without a border.
struct ImageCrop {
  int width = 0;   // [px] without the border
  int height = 0;  // [px]
  double focal_px = 0;
  Facing facing = Facing::Front;
  std::vector<std::uint16_t> depth_mm;  // (height + 2) rows of width + 2, and one value that nothing means
  std::vector<std::uint8_t> labels;     // height rows of width

  [[nodiscard]] int pitch() const { return width + 2; }
  [[nodiscard]] std::size_t bytes() const { return depth_mm.size() * sizeof(std::uint16_t) + labels.size(); }
};
void cropTrainingImage(const TrainingImage& image, ImageCrop& crop);

// Which of the training images a process has: those from count * rank / ranks on.
struct ImageShare {
  int rank = 0;
  int ranks = 1;
};

// A share of the training images as crops, each mirrored or not by the toss of a coin, so that left and right are
// balanced. Crops beyond the memory limit are rendered anew at every get(): slower, with the same result.
class ImageStore {
 public:
  // `progress` hears the share done, in [0, 1], from any thread.
  ImageStore(TrainingImageSource& source, const ImageShare& share, std::uint64_t seed, std::size_t memory_limit_bytes,
             int threads, const std::function<void(double)>& progress);

  [[nodiscard]] std::size_t count() const { return crops_.size(); }
  // The number among all images of the first one here.
  [[nodiscard]] std::size_t first() const { return first_; }
  [[nodiscard]] std::size_t cachedCount() const;
  // The i-th crop of those here, in memory or made in `scratch`. Thread-safe.
  const ImageCrop& get(std::size_t i, ImageCrop& scratch);

 private:
  void make(std::size_t i, ImageCrop& crop);

  TrainingImageSource& source_;
  std::uint64_t seed_;
  std::size_t first_;
  std::vector<ImageCrop> crops_;  // empty depth_mm: not kept
};

}  // namespace depthmocap

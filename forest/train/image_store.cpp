#include "forest/train/image_store.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "libtracker/classify/forest.h"
#include "libtracker/core/check.h"
#include "libtracker/core/parallel.h"
#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

constexpr std::uint64_t kMirrorStream = 0x4D49;

std::uint16_t millimetres(float depth_m) {
  return depth_m > 0.0F ? static_cast<std::uint16_t>(std::lround(std::min(depth_m, kBackgroundDepth_m) * 1000.0F))
                        : kBackgroundDepth_mm;
}

std::size_t firstOf(const ImageShare& share, std::size_t images) {
  return images * static_cast<std::size_t>(share.rank) / static_cast<std::size_t>(share.ranks);
}

}  // namespace

void cropTrainingImage(const TrainingImage& image, ImageCrop& crop) {
  DMC_CHECK(image.depth.width == image.labels.width && image.depth.height == image.labels.height);
  int x0 = image.depth.width, y0 = image.depth.height, x1 = 0, y1 = 0;
  for (int y = 0; y < image.depth.height; ++y) {
    for (int x = 0; x < image.depth.width; ++x) {
      if (!(image.depth.at(x, y) > 0.0F)) continue;
      x0 = std::min(x0, x);
      x1 = std::max(x1, x + 1);
      y0 = std::min(y0, y);
      y1 = y + 1;
    }
  }
  crop.width = std::max(0, x1 - x0);
  crop.height = std::max(0, y1 - y0);
  crop.focal_px = image.focal_px;
  crop.facing = image.facing.value_or(Facing::Front);
  const auto width = static_cast<std::size_t>(crop.width);
  const auto pitch = static_cast<std::size_t>(crop.pitch());
  crop.depth_mm.assign(pitch * static_cast<std::size_t>(crop.height + 2) + 1, kBackgroundDepth_mm);
  crop.labels.assign(width * static_cast<std::size_t>(crop.height), 0);
  for (std::size_t y = 0; y < static_cast<std::size_t>(crop.height); ++y) {
    const std::size_t from = image.depth.index(x0, y0 + static_cast<int>(y));
    for (std::size_t x = 0; x < width; ++x) {
      crop.depth_mm[(y + 1) * pitch + x + 1] = millimetres(image.depth.data[from + x]);
      if (image.depth.data[from + x] > 0.0F) crop.labels[y * width + x] = image.labels.data[from + x];
    }
  }
}

ImageStore::ImageStore(TrainingImageSource& source, const ImageShare& share, std::uint64_t seed,
                       std::size_t memory_limit_bytes, int threads, const std::function<void(double)>& progress)
    : source_(source), seed_(seed), first_(firstOf(share, source.count())) {
  crops_.resize(firstOf({share.rank + 1, share.ranks}, source.count()) - first_);
  std::atomic<std::size_t> used = 0;
  std::atomic<std::size_t> done = 0;
  parallelFor(threads, crops_.size(), [&](std::size_t i) {
    ImageCrop crop;
    if (used < memory_limit_bytes) {
      make(i, crop);
      const std::size_t bytes = crop.bytes();
      if (used.fetch_add(bytes) + bytes <= memory_limit_bytes) crops_[i] = std::move(crop);
    }
    progress(static_cast<double>(++done) / static_cast<double>(crops_.size()));
  });
}

std::size_t ImageStore::cachedCount() const {
  return static_cast<std::size_t>(
      std::count_if(crops_.begin(), crops_.end(), [](const ImageCrop& crop) { return !crop.depth_mm.empty(); }));
}

void ImageStore::make(std::size_t i, ImageCrop& crop) {
  TrainingImage image;
  source_.render(first_ + i, image);
  if ((Random(seed_ + first_ + i, kMirrorStream).next() & 1U) != 0) mirrorImage(image);
  cropTrainingImage(image, crop);
}

const ImageCrop& ImageStore::get(std::size_t i, ImageCrop& scratch) {
  if (!crops_[i].depth_mm.empty()) return crops_[i];
  make(i, scratch);
  return scratch;
}

}  // namespace depthmocap

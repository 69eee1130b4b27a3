#include "forest/train/forest_accuracy.h"

#include <algorithm>
#include <atomic>

#include "libtracker/classify/classify.h"
#include "libtracker/classify/label_image.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

void countPixels(const TrainingImage& image, const ClassifiedPixels& classified, ConfusionMatrix& confusion) {
  for (const auto& pixel : classified.pixels) {
    const std::uint8_t label = image.labels.at(pixel.x, pixel.y);
    if (label == 0) continue;
    ++confusion.count[label - 1U][static_cast<std::size_t>(mostProbablePart(pixel))];
  }
}

void countImage(const Forest& forest, const TrainingImage& image, int stride, ForestAccuracy& accuracy) {
  MaskImage mask(image.depth.width, image.depth.height, 0);
  for (std::size_t i = 0; i < mask.data.size(); ++i) mask.data[i] = image.depth.data[i] > 0.0F ? 1 : 0;
  ClassifyMemory memory;
  ClassifiedPixels classified;
  classify(forest, image.depth, mask, image.focal_px, {.stride = stride}, memory, classified);
  countPixels(image, classified, accuracy.all);
  if (!image.facing || classified.pixels.empty()) return;
  const auto truth = static_cast<std::size_t>(*image.facing);
  const auto& shares = classified.facing;
  const auto found = std::max_element(shares.begin(), shares.end()) - shares.begin();
  ++accuracy.facing[truth][static_cast<std::size_t>(found)];
  countPixels(image, classified, accuracy.from[truth]);
  if (forest.facings == 1) return;
  FacingShares told{};
  told[truth] = 1;
  assumeFacing(told, 1, memory, classified);
  countPixels(image, classified, accuracy.given_facing);
}

}  // namespace

void ConfusionMatrix::add(const ConfusionMatrix& other) {
  for (std::size_t row = 0; row < count.size(); ++row) {
    for (std::size_t column = 0; column < count.size(); ++column) count[row][column] += other.count[row][column];
  }
}

std::uint64_t ConfusionMatrix::total() const {
  std::uint64_t sum = 0;
  for (const auto& row : count) {
    for (const std::uint64_t n : row) sum += n;
  }
  return sum;
}

double ConfusionMatrix::accuracy() const {
  std::uint64_t right = 0;
  for (std::size_t part = 0; part < count.size(); ++part) right += count[part][part];
  const std::uint64_t all = total();
  return all == 0 ? 0.0 : static_cast<double>(right) / static_cast<double>(all);
}

double ConfusionMatrix::accuracyOf(int part_index) const {
  const auto part = static_cast<std::size_t>(part_index);
  std::uint64_t all = 0;
  for (const std::uint64_t n : count[part]) all += n;
  return all == 0 ? 0.0 : static_cast<double>(count[part][part]) / static_cast<double>(all);
}

double ConfusionMatrix::meanAccuracy() const {
  double sum = 0;
  int seen = 0;
  for (int part = 0; part < kPartCount; ++part) {
    std::uint64_t all = 0;
    for (const std::uint64_t n : count[static_cast<std::size_t>(part)]) all += n;
    if (all == 0) continue;
    sum += accuracyOf(part);
    ++seen;
  }
  return seen == 0 ? 0.0 : sum / seen;
}

void ForestAccuracy::add(const ForestAccuracy& other) {
  all.add(other.all);
  given_facing.add(other.given_facing);
  for (std::size_t row = 0; row < facing.size(); ++row) {
    from[row].add(other.from[row]);
    for (std::size_t column = 0; column < facing.size(); ++column) facing[row][column] += other.facing[row][column];
  }
}

double ForestAccuracy::facingAccuracy() const {
  std::uint64_t images = 0;
  std::uint64_t right = 0;
  for (std::size_t row = 0; row < facing.size(); ++row) {
    right += facing[row][row];
    for (const std::uint64_t n : facing[row]) images += n;
  }
  return images == 0 ? 0.0 : static_cast<double>(right) / static_cast<double>(images);
}

std::vector<ForestAccuracy> measureAccuracy(std::span<const Forest> forests, TrainingImageSource& source, int stride,
                                            int threads, const std::function<void(double)>& progress) {
  std::vector<ForestAccuracy> of_image(source.count() * forests.size());
  std::atomic<std::size_t> done = 0;
  parallelFor(threads, source.count(), [&](std::size_t i) {
    TrainingImage image;
    source.render(i, image);
    for (std::size_t f = 0; f < forests.size(); ++f)
      countImage(forests[f], image, stride, of_image[i * forests.size() + f]);
    progress(static_cast<double>(++done) / static_cast<double>(source.count()));
  });
  std::vector<ForestAccuracy> sums(forests.size());
  for (std::size_t k = 0; k < of_image.size(); ++k) sums[k % forests.size()].add(of_image[k]);
  return sums;
}

}  // namespace depthmocap

#include "libtracker/classify/label_image.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr int kFilled = 0x80;  // marks labels that were copied, while the copying goes on

constexpr int kWord = 8;  // [px] looked at together

// Whether none of the next kWord pixels of a mask's row, which has `width`, is set.
bool nothingFrom(const std::uint8_t* row, int x, int width) {
  if (x + kWord > width) return false;
  std::uint64_t word = 0;
  static_assert(sizeof word == kWord);
  std::memcpy(&word, row + x, sizeof word);
  return word == 0;
}

// The label of the classified pixel nearest to (x, y), searched in growing squares of the grid of classified pixels.
std::uint8_t nearestLabel(const PartImage& labels, int stride, int x, int y) {
  const int columns = (labels.width + stride - 1) / stride;
  const int rows = (labels.height + stride - 1) / stride;
  const int column = std::min((x + stride / 2) / stride, columns - 1);
  const int row = std::min((y + stride / 2) / stride, rows - 1);
  int best = std::numeric_limits<int>::max();
  std::uint8_t label = 0;
  const auto visit = [&](int i, int j) {
    if (i < 0 || j < 0 || i >= columns || j >= rows) return;
    const std::uint8_t found = labels.at(i * stride, j * stride);
    const int distance = (i * stride - x) * (i * stride - x) + (j * stride - y) * (j * stride - y);
    if (found == 0 || (found & kFilled) != 0 || distance >= best) return;
    best = distance;
    label = found;
  };
  visit(column, row);
  if (label != 0) return label;  // no other pixel of the grid is nearer
  for (int ring = 1; ring < std::max(columns, rows); ++ring) {
    // Every pixel of this ring lies at least so far away from (x, y).
    const int nearest = std::max(0, ring * stride - stride / 2);
    if (nearest * nearest >= best) break;
    for (int j = row - ring; j <= row + ring; ++j) {
      const int step = std::abs(j - row) == ring ? 1 : 2 * ring;
      for (int i = column - ring; i <= column + ring; i += step) visit(i, j);
    }
  }
  return label;
}

}  // namespace

int mostProbablePart(const ClassifiedPixels::Pixel& pixel) {
  return static_cast<int>(std::max_element(pixel.probability.begin(), pixel.probability.end()) -
                          pixel.probability.begin());
}

void labelImage(const ClassifiedPixels& pixels, const MaskImage& mask, PartImage& labels) {
  labels.reset(mask.width, mask.height, 0);
  for (const auto& pixel : pixels.pixels) {
    DMC_CHECK(labels.contains(pixel.x, pixel.y));
    labels.at(pixel.x, pixel.y) = static_cast<std::uint8_t>(partAt(mostProbablePart(pixel)));
  }
  if (pixels.pixels.empty()) return;
  for (int y = 0; y < mask.height; ++y) {
    const std::uint8_t* row = &mask.at(0, y);
    for (int x = 0; x < mask.width; ++x) {
      if (nothingFrom(row, x, mask.width)) {
        x += kWord - 1;
        continue;
      }
      if (mask.at(x, y) == 0 || labels.at(x, y) != 0) continue;
      labels.at(x, y) = static_cast<std::uint8_t>(nearestLabel(labels, pixels.stride, x, y) | kFilled);
    }
  }
  for (std::uint8_t& label : labels.data) label = static_cast<std::uint8_t>(label & ~kFilled);
}

}  // namespace depthmocap

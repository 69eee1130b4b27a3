#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "forest/train/training_image.h"
#include "libtracker/classify/forest.h"

namespace depthmocap {

// Pixels counted by true part (row) and most probable part (column), indices 0 .. 14.
struct ConfusionMatrix {
  std::array<std::array<std::uint64_t, kPartCount>, kPartCount> count{};

  void add(const ConfusionMatrix& other);
  [[nodiscard]] std::uint64_t total() const;
  // Share of all pixels that are right, [0, 1].
  [[nodiscard]] double accuracy() const;
  // Share of a part's pixels that are right; 0 where the part was never seen.
  [[nodiscard]] double accuracyOf(int part_index) const;
  // Mean of accuracyOf() over the parts that were seen: the figure of Shotton 2011.
  [[nodiscard]] double meanAccuracy() const;
};

// What a forest knows of labelled images.
struct ForestAccuracy {
  ConfusionMatrix all;
  std::array<ConfusionMatrix, kFacingCount> from;  // of the images seen from each side, where that is known
  ConfusionMatrix given_facing;                    // had the side been told
  // Images by true (row) and most probable (column) facing, where the true one is known.
  std::array<std::array<std::uint64_t, kFacingCount>, kFacingCount> facing{};

  void add(const ForestAccuracy& other);
  // Share of the images whose facing was found, [0, 1]; 0 where none is known.
  [[nodiscard]] double facingAccuracy() const;
};

// Classifies labelled pixels of all images of the source (every stride-th in x and y) with each of the forests and
// compares; one result a forest. `progress` hears the share done.
std::vector<ForestAccuracy> measureAccuracy(std::span<const Forest> forests, TrainingImageSource& source, int stride,
                                            int threads, const std::function<void(double)>& progress);

}  // namespace depthmocap

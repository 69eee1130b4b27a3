#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace depthmocap {

// Outputs that are computed together; with 16 pixels of each their sums fit the registers of AVX2.
inline constexpr int kOutputBlock = 4;

// No training gives weights that come near this; what a damaged file gives stays finite through all layers.
inline constexpr float kMostOutput = 1e20F;

// One row of a block of outputs of a convolution.
struct RowJob {
  static constexpr int kMostTaps = 25;
  std::array<const std::int32_t*, kMostTaps> taps{};  // where each tap reads the first pair of maps for pixel 0
  int tap_count = 0;
  std::ptrdiff_t pair_size = 0;  // from a pair of maps to the next one
  int pairs = 0;
  const std::int32_t* weights = nullptr;    // [pairs][taps][kOutputBlock], paired as the maps are
  std::array<float, kOutputBlock> units{};  // what 1 in the sum of an output stands for
  std::array<float, kOutputBlock> biases{};
  std::array<float*, kOutputBlock> to{};  // room for whole vectors
  int outputs = 0;                        // (1 .. kOutputBlock) that are wanted
  int width = 0;                          // [px]
  float least = 0;                        // outputs are raised to this, and lowered to kMostOutput
};

using ConvolveRow = void (*)(const RowJob& job);

// The fastest one of this machine, or the one for any machine. Both give the same bits.
ConvolveRow convolveRowFor(bool simd);

}  // namespace depthmocap

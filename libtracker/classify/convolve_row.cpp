#include "libtracker/classify/convolve_row.h"

#include <algorithm>
#include <cstring>

#include "libtracker/classify/feature_maps.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace depthmocap {
namespace {

constexpr int kPixels = FeatureMaps::kVector;

// Sums of one pixel vector, in registers.
using Vector = std::int32_t __attribute__((vector_size(kPixels * sizeof(std::int32_t))));

void convolveRow(const RowJob& job) {
  for (int x = 0; x < job.width; x += kPixels) {
    Vector sums[kOutputBlock] = {};
    const std::int32_t* weights = job.weights;
    for (int p = 0; p < job.pairs; ++p) {
      for (int t = 0; t < job.tap_count; ++t) {
        Vector pair;
        std::memcpy(&pair, job.taps[static_cast<std::size_t>(t)] + p * job.pair_size + x, sizeof pair);
        const Vector a = (pair << 16) >> 16;
        const Vector b = pair >> 16;
        for (Vector& sum : sums) {
          const std::int32_t w = *weights++;
          sum += a * static_cast<std::int16_t>(w) + b * (w >> 16);
        }
      }
    }
    for (std::size_t o = 0; o < static_cast<std::size_t>(job.outputs); ++o) {
      for (int k = 0; k < kPixels; ++k) {
        const float value = static_cast<float>(sums[o][k]) * job.units[o] + job.biases[o];
        job.to[o][x + k] = std::clamp(value, job.least, kMostOutput);
      }
    }
  }
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) void convolveRowAvx2(const RowJob& job) {
  constexpr int kLanes = kPixels / 2;
  for (int x = 0; x < job.width; x += kPixels) {
    __m256i sums[kOutputBlock][2];
    for (auto& sum : sums) sum[0] = sum[1] = _mm256_setzero_si256();
    const std::int32_t* weights = job.weights;
    for (int p = 0; p < job.pairs; ++p) {
      for (int t = 0; t < job.tap_count; ++t) {
        const std::int32_t* from = job.taps[static_cast<std::size_t>(t)] + p * job.pair_size + x;
        const __m256i a = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
        const __m256i b = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from + kLanes));
        for (auto& sum : sums) {
          const __m256i w = _mm256_set1_epi32(*weights++);
          sum[0] = _mm256_add_epi32(sum[0], _mm256_madd_epi16(a, w));
          sum[1] = _mm256_add_epi32(sum[1], _mm256_madd_epi16(b, w));
        }
      }
    }
    for (std::size_t o = 0; o < static_cast<std::size_t>(job.outputs); ++o) {
      for (int half = 0; half < 2; ++half) {
        const __m256 scaled = _mm256_mul_ps(_mm256_cvtepi32_ps(sums[o][half]), _mm256_set1_ps(job.units[o]));
        const __m256 moved = _mm256_add_ps(scaled, _mm256_set1_ps(job.biases[o]));
        const __m256 raised = _mm256_max_ps(moved, _mm256_set1_ps(job.least));
        _mm256_storeu_ps(job.to[o] + x + half * kLanes, _mm256_min_ps(raised, _mm256_set1_ps(kMostOutput)));
      }
    }
  }
}
#endif

}  // namespace

ConvolveRow convolveRowFor(bool simd) {
#if defined(__x86_64__)
  if (simd && __builtin_cpu_supports("avx2")) return convolveRowAvx2;
#endif
  return convolveRow;
}

}  // namespace depthmocap

#pragma once
#if defined(__x86_64__)
#include <immintrin.h>

// Eight probes at a time, for functions compiled for AVX2. The arithmetic is that of wholePixels() and
// ActorDepth::probe().
#define DMC_AVX2_INLINE __attribute__((target("avx2"), always_inline)) inline

namespace depthmocap {

struct Avx2Limits {
  __m256i pitch, last_column, last_row;
};

DMC_AVX2_INLINE Avx2Limits avx2Limits(int width, int height) {
  return {_mm256_set1_epi32(width + 2), _mm256_set1_epi32(width + 1), _mm256_set1_epi32(height + 1)};
}

DMC_AVX2_INLINE __m256i wholePixels8(__m256i offset, __m256 scale) {
  const __m256 shifted = _mm256_add_ps(_mm256_mul_ps(_mm256_cvtepi32_ps(offset), scale), _mm256_set1_ps(4096.5F));
  return _mm256_sub_epi32(_mm256_cvttps_epi32(shifted), _mm256_set1_epi32(4096));
}

// Index into the cut-out of the probes at eight offsets (x in the low, y in the high half of each lane) from eight
// pixels.
DMC_AVX2_INLINE __m256i probeIndex8(const Avx2Limits& limits, __m256i x, __m256i y, __m256 scale, __m256i offset_xy) {
  const __m256i zero = _mm256_setzero_si256();
  const __m256i offset_x = _mm256_srai_epi32(_mm256_slli_epi32(offset_xy, 16), 16);
  const __m256i offset_y = _mm256_srai_epi32(offset_xy, 16);
  __m256i column = _mm256_add_epi32(x, wholePixels8(offset_x, scale));
  __m256i row = _mm256_add_epi32(y, wholePixels8(offset_y, scale));
  column = _mm256_min_epi32(_mm256_max_epi32(column, zero), limits.last_column);
  row = _mm256_min_epi32(_mm256_max_epi32(row, zero), limits.last_row);
  return _mm256_add_epi32(_mm256_mullo_epi32(row, limits.pitch), column);
}

}  // namespace depthmocap
#endif

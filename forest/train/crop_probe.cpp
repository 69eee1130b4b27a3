#include "forest/train/crop_probe.h"

#include "libtracker/classify/probe_avx2.h"

namespace depthmocap {
namespace {

#if defined(__x86_64__)
// As many of the offsets as fill whole vectors; how many those are. Gathers read 32 bits: one value more than is asked
// for.
__attribute__((target("avx2"))) std::size_t readProbesAvx2(const ImageCrop& crop, int x, int y, float scale,
                                                           const std::vector<ProbeOffset>& offsets,
                                                           std::uint16_t* probes_mm) {
  const Avx2Limits limits = avx2Limits(crop.width, crop.height);
  const __m256i column = _mm256_set1_epi32(x);
  const __m256i row = _mm256_set1_epi32(y);
  const __m256 scales = _mm256_set1_ps(scale);
  const auto* depth = reinterpret_cast<const int*>(crop.depth_mm.data());
  std::size_t i = 0;
  for (; i + 8 <= offsets.size(); i += 8) {
    const __m256i offset = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(&offsets[i]));
    const __m256i index = probeIndex8(limits, column, row, scales, offset);
    const __m256i wide = _mm256_and_si256(_mm256_i32gather_epi32(depth, index, 2), _mm256_set1_epi32(0xFFFF));
    const __m128i narrow = _mm_packus_epi32(_mm256_castsi256_si128(wide), _mm256_extracti128_si256(wide, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(probes_mm + i), narrow);
  }
  return i;
}
#endif

}  // namespace

void readProbesOfPixel(const ImageCrop& crop, int x, int y, const std::vector<ProbeOffset>& offsets,
                       std::uint16_t* probes_mm) {
  const float scale = probeScaleAt(crop, x, y);
  std::size_t i = 0;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) i = readProbesAvx2(crop, x, y, scale, offsets, probes_mm);
#endif
  for (; i < offsets.size(); ++i) probes_mm[i] = probeCrop_mm(crop, x, y, scale, offsets[i]);
}

}  // namespace depthmocap

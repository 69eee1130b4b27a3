#include "libtracker/classify/descend.h"

#include <cstddef>

#include "libtracker/classify/probe_avx2.h"

namespace depthmocap {
namespace {

bool goesRight(const ForestNode& node, const ActorDepth& actor, const PixelLanes& pixels, std::size_t lane) {
  const auto probe = [&](const std::array<std::int16_t, 2>& offset) {
    return actor.probe(pixels.x[lane] + wholePixels(static_cast<float>(offset[0]) * pixels.scale[lane]),
                       pixels.y[lane] + wholePixels(static_cast<float>(offset[1]) * pixels.scale[lane]));
  };
  return !(probe(node.u) - probe(node.v) < node.threshold_m);
}

}  // namespace

void descendPortable(const ForestTree& tree, const ActorDepth& actor, const PixelLanes& pixels, LeafLanes& leaves) {
  std::array<std::int32_t, kLanes> at{};
  // All lanes take one step before any takes the next, so that their cache misses overlap.
  for (bool moved = true; moved;) {
    moved = false;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const ForestNode& node = tree.nodes[static_cast<std::size_t>(at[lane])];
      if (node.child <= 0) continue;
      at[lane] = node.child + (goesRight(node, actor, pixels, lane) ? 1 : 0);
      moved = true;
    }
  }
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    leaves[lane] = -tree.nodes[static_cast<std::size_t>(at[lane])].child;
}

#if defined(__x86_64__)
namespace {

static_assert(sizeof(ForestNode) == 16 && offsetof(ForestNode, v) == 4 && offsetof(ForestNode, threshold_m) == 8 &&
              offsetof(ForestNode, child) == 12);

// Eight pixels; nodes are read as four gathered 32-bit columns.
struct Avx2Lanes {
  __m256i x, y;
  __m256 scale;
  __m256i node;
};

struct Avx2Frame {
  const float* depth;
  Avx2Limits limits;
};

DMC_AVX2_INLINE __m256 probe8(const Avx2Frame& frame, const Avx2Lanes& lanes, __m256i offset_xy) {
  return _mm256_i32gather_ps(frame.depth, probeIndex8(frame.limits, lanes.x, lanes.y, lanes.scale, offset_xy), 4);
}

// One step down; the result says which lanes were not in a leaf yet.
DMC_AVX2_INLINE int step8(const int* nodes, const Avx2Frame& frame, Avx2Lanes& lanes) {
  const __m256i word = _mm256_slli_epi32(lanes.node, 2);
  const __m256i child = _mm256_i32gather_epi32(nodes + 3, word, 4);
  const __m256i inner = _mm256_cmpgt_epi32(child, _mm256_setzero_si256());
  const int moved = _mm256_movemask_ps(_mm256_castsi256_ps(inner));
  if (moved == 0) return 0;
  const __m256i u = _mm256_i32gather_epi32(nodes, word, 4);
  const __m256i v = _mm256_i32gather_epi32(nodes + 1, word, 4);
  const __m256 threshold = _mm256_castsi256_ps(_mm256_i32gather_epi32(nodes + 2, word, 4));
  const __m256 feature = _mm256_sub_ps(probe8(frame, lanes, u), probe8(frame, lanes, v));
  const __m256i right = _mm256_castps_si256(_mm256_cmp_ps(feature, threshold, _CMP_NLT_UQ));  // -1 where right
  lanes.node = _mm256_blendv_epi8(lanes.node, _mm256_sub_epi32(child, right), inner);
  return moved;
}

}  // namespace

__attribute__((target("avx2"))) void descendAvx2(const ForestTree& tree, const ActorDepth& actor,
                                                 const PixelLanes& pixels, LeafLanes& leaves) {
  static_assert(kLanes == 16);
  const auto* nodes = reinterpret_cast<const int*>(tree.nodes.data());
  const Avx2Frame frame{actor.depth_m.data(), avx2Limits(actor.width, actor.height)};
  const auto load = [&](std::size_t i) __attribute__((target("avx2"))) {
    return Avx2Lanes{_mm256_load_si256(reinterpret_cast<const __m256i*>(&pixels.x[i])),
                     _mm256_load_si256(reinterpret_cast<const __m256i*>(&pixels.y[i])),
                     _mm256_load_ps(&pixels.scale[i]), _mm256_setzero_si256()};
  };
  Avx2Lanes first = load(0);
  Avx2Lanes second = load(8);
  while ((step8(nodes, frame, first) | step8(nodes, frame, second)) != 0) {
  }
  alignas(32) std::array<std::int32_t, kLanes> at;
  _mm256_store_si256(reinterpret_cast<__m256i*>(at.data()), first.node);
  _mm256_store_si256(reinterpret_cast<__m256i*>(at.data() + 8), second.node);
  for (std::size_t lane = 0; lane < kLanes; ++lane)
    leaves[lane] = -tree.nodes[static_cast<std::size_t>(at[lane])].child;
}
#endif

Descend chooseDescend(bool simd) {
#if defined(__x86_64__)
  if (simd && __builtin_cpu_supports("avx2")) return descendAvx2;
#endif
  (void)simd;
  return descendPortable;
}

}  // namespace depthmocap

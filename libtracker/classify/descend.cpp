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

// Eight pixels on their way.
struct Avx2Lanes {
  __m256i x, y;
  __m256 scale;
  __m256i node;
};

struct Avx2Frame {
  const float* depth;
  Avx2Limits limits;
};

// The four columns (u, v, threshold, child) of the nodes that eight lanes are at. Whole nodes are loaded and
// transposed: a gather of each column would ask for the same eight cache lines four times.
struct NodeColumns {
  __m256i u, v, threshold, child;
};

DMC_AVX2_INLINE __m256i twoNodes(const ForestNode* nodes, std::int32_t low, std::int32_t high) {
  const auto at = [&](std::int32_t i) __attribute__((target("avx2"))) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(nodes + i));
  };
  return _mm256_inserti128_si256(_mm256_castsi128_si256(at(low)), at(high), 1);
}

DMC_AVX2_INLINE NodeColumns loadNodes8(const ForestNode* nodes, __m256i node) {
  alignas(32) std::array<std::int32_t, 8> at;
  _mm256_store_si256(reinterpret_cast<__m256i*>(at.data()), node);
  const __m256i n04 = twoNodes(nodes, at[0], at[4]);
  const __m256i n15 = twoNodes(nodes, at[1], at[5]);
  const __m256i n26 = twoNodes(nodes, at[2], at[6]);
  const __m256i n37 = twoNodes(nodes, at[3], at[7]);
  const __m256i uv_01 = _mm256_unpacklo_epi32(n04, n15);  // u0 u1 v0 v1
  const __m256i uv_23 = _mm256_unpacklo_epi32(n26, n37);
  const __m256i tc_01 = _mm256_unpackhi_epi32(n04, n15);  // t0 t1 c0 c1
  const __m256i tc_23 = _mm256_unpackhi_epi32(n26, n37);
  return {_mm256_unpacklo_epi64(uv_01, uv_23), _mm256_unpackhi_epi64(uv_01, uv_23), _mm256_unpacklo_epi64(tc_01, tc_23),
          _mm256_unpackhi_epi64(tc_01, tc_23)};
}

struct ProbeIndices {
  __m256i u, v;
};

constexpr std::size_t kVectors = kLanes / 8;

// All lanes one step down, each stage for all vectors before the next stage: the loads of one stage wait together. The
// result says whether a lane was not in a leaf yet.
DMC_AVX2_INLINE bool stepAll(const ForestNode* nodes, const Avx2Frame& frame, std::array<Avx2Lanes, kVectors>& lanes) {
  std::array<NodeColumns, kVectors> at;
  for (std::size_t i = 0; i < kVectors; ++i) at[i] = loadNodes8(nodes, lanes[i].node);
  std::array<ProbeIndices, kVectors> probes;
  for (std::size_t i = 0; i < kVectors; ++i) {
    probes[i] = {probeIndex8(frame.limits, lanes[i].x, lanes[i].y, lanes[i].scale, at[i].u),
                 probeIndex8(frame.limits, lanes[i].x, lanes[i].y, lanes[i].scale, at[i].v)};
  }
  int moved = 0;
  for (std::size_t i = 0; i < kVectors; ++i) {
    const __m256 feature = _mm256_sub_ps(_mm256_i32gather_ps(frame.depth, probes[i].u, 4),
                                         _mm256_i32gather_ps(frame.depth, probes[i].v, 4));
    const __m256 threshold = _mm256_castsi256_ps(at[i].threshold);
    const __m256i right = _mm256_castps_si256(_mm256_cmp_ps(feature, threshold, _CMP_NLT_UQ));  // -1 where right
    const __m256i inner = _mm256_cmpgt_epi32(at[i].child, _mm256_setzero_si256());
    lanes[i].node = _mm256_blendv_epi8(lanes[i].node, _mm256_sub_epi32(at[i].child, right), inner);
    moved |= _mm256_movemask_ps(_mm256_castsi256_ps(inner));
  }
  return moved != 0;
}

}  // namespace

__attribute__((target("avx2"))) void descendAvx2(const ForestTree& tree, const ActorDepth& actor,
                                                 const PixelLanes& pixels, LeafLanes& leaves) {
  const ForestNode* nodes = tree.nodes.data();
  const Avx2Frame frame{actor.depth_m.data(), avx2Limits(actor.width, actor.height)};
  std::array<Avx2Lanes, kVectors> lanes;
  for (std::size_t i = 0; i < kVectors; ++i) {
    lanes[i] = {_mm256_load_si256(reinterpret_cast<const __m256i*>(&pixels.x[8 * i])),
                _mm256_load_si256(reinterpret_cast<const __m256i*>(&pixels.y[8 * i])),
                _mm256_load_ps(&pixels.scale[8 * i]), _mm256_setzero_si256()};
  }
  while (stepAll(nodes, frame, lanes)) {
  }
  alignas(32) std::array<std::int32_t, kLanes> at;
  for (std::size_t i = 0; i < kVectors; ++i) {
    _mm256_store_si256(reinterpret_cast<__m256i*>(at.data() + 8 * i), lanes[i].node);
  }
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

#pragma once
#include <array>
#include <cstdint>

#include "libtracker/classify/actor_depth.h"
#include "libtracker/classify/forest.h"

namespace depthmocap {

inline constexpr int kLanes = 64;  // pixels that go down a tree together

// Pixels on their way down: place in the cut-out and the scale of their offsets. Unused lanes repeat the first one.
struct PixelLanes {
  alignas(32) std::array<std::int32_t, kLanes> x{};
  alignas(32) std::array<std::int32_t, kLanes> y{};
  alignas(32) std::array<float, kLanes> scale{};
};

// The leaf (index into tree.leaves) that each pixel ends in. Both give the same answer.
using LeafLanes = std::array<std::int32_t, kLanes>;
void descendPortable(const ForestTree& tree, const ActorDepth& actor, const PixelLanes& pixels, LeafLanes& leaves);
#if defined(__x86_64__)
void descendAvx2(const ForestTree& tree, const ActorDepth& actor, const PixelLanes& pixels, LeafLanes& leaves);
#endif

using Descend = decltype(&descendPortable);
// The fastest that this processor can run.
Descend chooseDescend(bool simd);

}  // namespace depthmocap

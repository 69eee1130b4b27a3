#pragma once
#include <array>
#include <cstdint>

namespace depthmocap {

// Which side of the actor the camera sees: the direction from the actor to the camera in the frame of the hips, to the
// nearest quarter turn. Left is the actor's own.
enum class Facing : std::uint8_t { Front, Left, Back, Right };

inline constexpr int kFacingCount = 4;

// A number for each facing, by its index.
using FacingShares = std::array<float, kFacingCount>;

// The same side of the mirror image.
constexpr Facing mirrored(Facing facing) {
  return static_cast<Facing>((kFacingCount - static_cast<int>(facing)) % kFacingCount);
}

}  // namespace depthmocap

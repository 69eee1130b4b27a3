#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "libtracker/segment/coarse_cloud.h"

namespace depthmocap {

// [m] What is nearer by this is in front: more than depth noise.
inline constexpr float kInFront_m = 0.15F;

// True where something nearer covers a part of the actor: along more than a few cells of the outline the neighbour is
// in front of it. `keep`: 0 for floor and walls, which hide nobody; `labels` each cell's component, `selected` 1 for
// the actor's.
bool isPartlyHidden(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep,
                    const std::vector<std::int32_t>& labels, const std::vector<std::uint8_t>& selected);

// True where the actor's lower end is not in view: below most of the actor's columns lies something nearer or the end
// of the picture, or the floor, where it is known, is far below. Arguments as of isPartlyHidden(); `floor`: plane n.p +
// d = 0, n up, camera frame.
bool isCutBelow(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep,
                const std::vector<std::int32_t>& labels, const std::vector<std::uint8_t>& selected,
                const std::optional<Eigen::Vector4f>& floor);

}  // namespace depthmocap

#pragma once
#include <cstdint>
#include <vector>

#include "libtracker/segment/coarse_cloud.h"

namespace depthmocap {

// True where something nearer covers a part of the actor: along more than a few cells of the outline the neighbour is
// in front of it. `keep`: 0 for floor and walls, which hide nobody; `labels` each cell's component, `selected` 1 for
// the actor's.
bool isPartlyHidden(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep,
                    const std::vector<std::int32_t>& labels, const std::vector<std::uint8_t>& selected);

}  // namespace depthmocap

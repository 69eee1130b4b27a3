#pragma once
#include <cstdint>
#include <vector>

#include "depthmocap/image.h"
#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/components.h"

namespace depthmocap {

// A flat thing: a door, the front of a cupboard, a board that is held before people. Small pieces are, too.
bool isPanel(const Component& component);

// Takes 15 % of the measured cells or more.
bool isLarge(const Component& component, const CoarseCloud& cloud);

// Large panels that stand before everything else: 1 for each component that is one. Returns how many cells they take.
int findBoards(const CoarseCloud& cloud, const std::vector<Component>& components, std::vector<std::uint8_t>& is_board);

// A copy of the picture in which nothing is measured where its boards are. Reuses memory.
void takeAwayBoards(const DepthImage& depth, const CoarseCloud& cloud, const ComponentFinder& pieces,
                    const std::vector<std::uint8_t>& is_board, DepthImage& without);

}  // namespace depthmocap

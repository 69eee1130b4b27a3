#pragma once
#include <filesystem>

#include "libtracker/classify/forest.h"

namespace depthmocap {

// loadForest throws Error (missing, not a forest, truncated, checksum, version, counts that do not fit together); no
// file makes it allocate more than its size justifies. saveForest writes the file whole or not at all; it numbers the
// nodes of each tree breadth-first, rounds thresholds to millimetres and cuts an origin after 4096 bytes. The format is
// described in forest_layout.h.
Forest loadForest(const std::filesystem::path& path);
void saveForest(const Forest& forest, const std::filesystem::path& path);

}  // namespace depthmocap

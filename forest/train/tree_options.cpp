#include "forest/train/tree_options.h"

#include "libtracker/core/config_fields.h"

namespace depthmocap {
void TreeOptions::validate() const {
  checkConfig(features.offsets >= 2 && features.offsets <= 4096, "TreeOptions", "offsets",
              static_cast<double>(features.offsets), "from 2 to 4096");
  checkConfig(features.min_offset > 0, "TreeOptions", "min_offset", static_cast<double>(features.min_offset),
              "above 0");
  checkConfig(features.max_offset > features.min_offset && features.max_offset < 32767, "TreeOptions", "max_offset",
              static_cast<double>(features.max_offset), "above min_offset and below 32767");
  checkConfig(features.center_share >= 0 && features.center_share <= 1, "TreeOptions", "center_share",
              static_cast<double>(features.center_share), "from 0 to 1");
  checkConfig(depth >= 1 && depth <= 30, "TreeOptions", "depth", static_cast<double>(depth), "from 1 to 30");
  checkConfig(pixels_per_image >= 1 && pixels_per_image <= 10000, "TreeOptions", "pixels",
              static_cast<double>(pixels_per_image), "from 1 to 10000");
  checkConfig(candidates >= 1 && candidates <= 100000, "TreeOptions", "candidates", static_cast<double>(candidates),
              "from 1 to 100000");
  checkConfig(min_leaf >= 1, "TreeOptions", "min_leaf", static_cast<double>(min_leaf), "at least 1");
  checkConfig(facing_weight >= 0 && facing_weight <= 64, "TreeOptions", "facing_weight",
              static_cast<double>(facing_weight), "from 0 to 64");
  checkConfig(max_nodes >= 3 && max_nodes <= (1U << 23U), "TreeOptions", "max_nodes", static_cast<double>(max_nodes),
              "from 3 to 8388608");
  checkConfig(node_samples >= 2, "TreeOptions", "node_samples", static_cast<double>(node_samples), "at least 2");
  checkConfig(batch_samples >= node_samples, "TreeOptions", "batch_samples", static_cast<double>(batch_samples),
              "at least node_samples");
}

}  // namespace depthmocap

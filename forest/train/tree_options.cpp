#include "forest/train/tree_options.h"

#include <fmt/format.h>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

template <typename T>
void require(bool holds, const char* field, T value, const char* rule) {
  if (!holds) throw Error(fmt::format("{} does not satisfy: {}", value, rule), field, "choose a value in the range");
}

}  // namespace

void TreeOptions::validate() const {
  require(features.offsets >= 2 && features.offsets <= 4096, "offsets", features.offsets, "2 .. 4096");
  require(features.min_offset > 0, "min_offset", features.min_offset, "> 0");
  require(features.max_offset > features.min_offset && features.max_offset < 32767, "max_offset", features.max_offset,
          "min_offset .. 32766");
  require(features.center_share >= 0 && features.center_share <= 1, "center_share", features.center_share, "0 .. 1");
  require(depth >= 1 && depth <= 30, "depth", depth, "1 .. 30");
  require(pixels_per_image >= 1 && pixels_per_image <= 10000, "pixels", pixels_per_image, "1 .. 10000");
  require(candidates >= 1 && candidates <= 100000, "candidates", candidates, "1 .. 100000");
  require(min_leaf >= 1, "min_leaf", min_leaf, ">= 1");
  require(facing_weight >= 0 && facing_weight <= 64, "facing_weight", facing_weight, "0 .. 64");
  require(max_nodes >= 3 && max_nodes <= (1U << 23U), "max_nodes", max_nodes, "3 .. 8388608");
  require(node_samples >= 2, "node_samples", node_samples, ">= 2");
  require(batch_samples >= node_samples, "batch_samples", batch_samples, ">= node_samples");
}

}  // namespace depthmocap

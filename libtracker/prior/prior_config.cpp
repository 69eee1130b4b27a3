#include "libtracker/prior/prior_config.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

// Strictly ascending values within [least, most], at least one.
void requireList(const char* field, const std::vector<int>& values, int least, int most) {
  const bool in_range = !values.empty() && values.front() >= least && values.back() <= most;
  const bool ascending = std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
  if (in_range && ascending) return;
  throw Error(fmt::format("{} must be ascending whole numbers from {} to {}", field, least, most),
              "local prior settings");
}

}  // namespace

void PriorConfig::validate() const {
  requireList("neighbours", neighbours, 3, kMaxPriorNeighbours);
  requireList("dims", dims, 1, kMaxPriorDims);
  if (!(residual_rad >= 0)) throw Error("residual_rad must not be negative", "local prior settings");
  if (held_out < 1 || held_out > neighbours.front()) {
    throw Error(fmt::format("held_out = {}, but it must be from 1 to the smallest of neighbours, {}", held_out,
                            neighbours.front()),
                "local prior settings");
  }
}

}  // namespace depthmocap

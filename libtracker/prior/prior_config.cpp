#include "libtracker/prior/prior_config.h"

#include <algorithm>
#include <functional>
#include <string>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

void checkAscending(const char* field, const std::vector<int>& values) {
  const bool ascending = std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
  if (values.empty() || !ascending) throw Error(std::string(field) + " must be ascending, at least one", "PriorConfig");
}

}  // namespace

std::vector<ConfigField> PriorConfig::fields() {
  return {
      {"neighbours", &neighbours, "poses", fromTo(3, kMaxPriorNeighbours),
       "Numbers K of neighbours to choose from, ascending"},
      {"dims", &dims, "", fromTo(1, kMaxPriorDims), "Numbers B of dimensions to choose from, ascending"},
      {"held_out", &held_out, "poses", atLeast(1), "Nearest poses left out in turn to choose K and B"},
      {"residual_rad", &residual_rad, "rad", atLeast(0),
       "0: the subspace of the paper; otherwise a Gaussian with this deviation in every direction"},
  };
}

void PriorConfig::validate() const {
  checkFieldsOf("PriorConfig", *this);
  checkAscending("neighbours", neighbours);
  checkAscending("dims", dims);
  checkConfig(held_out <= neighbours.front(), "PriorConfig", "held_out", held_out,
              "at most the smallest of neighbours");
}

}  // namespace depthmocap

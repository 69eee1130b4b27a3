#pragma once
#include <vector>

#include "libtracker/core/config_fields.h"
#include "libtracker/skeleton/local_prior.h"

namespace depthmocap {

inline constexpr int kMaxPriorNeighbours = 50;  // the paper's bound on K

// Which local models (4) a frame may choose from.
struct PriorConfig {
  std::vector<int> neighbours = {15, 30, 50};  // [poses] (3 .. 50, ascending) K
  std::vector<int> dims = {3, 5, 7};           // (1 .. 32, ascending) B
  int held_out = 8;  // [poses] (1 .. smallest K) nearest poses left out in turn to choose K and B
  // [rad] (>= 0) 0: the paper's subspace. Else a Gaussian over the largest K and all directions, which a pose leaves by
  // so much: nothing is chosen.
  double residual_rad = 0;
  std::vector<ConfigField> fields();
  void validate() const;  // throws Error naming field, value and rule
};

}  // namespace depthmocap

#pragma once
#include "libtracker/core/random.h"

namespace depthmocap {

// A value within +-share of the given one.
inline double drawNear(Random& random, double value, double share = 0.15) {
  return value * random.uniform(1.0 - share, 1.0 + share);
}

inline bool drawChance(Random& random, double probability) {
  return random.uniform() < probability;
}

}  // namespace depthmocap

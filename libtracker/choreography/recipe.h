#pragma once
#include <span>
#include <string_view>

#include "libtracker/choreography/gait.h"
#include "libtracker/choreography/key_poses.h"
#include "libtracker/choreography/motion_finish.h"

namespace depthmocap {

// What a recipe works with. Every random choice comes from `random`.
struct Studio {
  const Skeleton& skeleton;
  Random& random;
  int variant;  // 0, 1, ...

  double uniform(double low, double high) { return random.uniform(low, high); }
  // A value within +-share of the given one.
  double near(double value, double share = 0.15) { return value * random.uniform(1.0 - share, 1.0 + share); }
  bool chance(double probability) { return random.uniform() < probability; }
  // The keys at a random tempo, every key a little different.
  BodyFrames play(const KeySequence& sequence, double spread = 0.03) {
    return playKeys(skeleton, sequence, {random.uniform(0.85, 1.15), spread, 1.3 * spread}, random);
  }
};

struct Recipe {
  std::string_view name;
  int variants;  // even ones are performed mirrored
  RawMotion (*make)(Studio&);
};

// The motions of each subject, one file each.
std::span<const Recipe> locomotionRecipes();

}  // namespace depthmocap

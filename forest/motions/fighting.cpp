#include <array>

#include "forest/motions/postures.h"
#include "forest/motions/recipe.h"

// Boxing and kicking.

namespace depthmocap {
namespace {

RawMotion box(Studio& studio) {
  KeySequence s(boxingGuard());
  s.at(0.0);
  for (int i = 0; i < 3; ++i) {
    KeyPose& jab = s.then(0.17);
    jab.left = {-0.12, 0.07, 0.50};
    jab.spine.twist = -0.35;
    s.base(0.30);
  }
  return {studio.play(s)};
}

constexpr std::array kRecipes = {Recipe{"box_jab", 2, &box}};

}  // namespace

std::span<const Recipe> fightingRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

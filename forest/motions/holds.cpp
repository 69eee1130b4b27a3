#include <array>

#include "forest/motions/postures.h"
#include "forest/motions/recipe.h"

namespace depthmocap {
namespace {

RawMotion hold(Studio& studio, const HandTarget& hand) {
  KeyPose pose = standing(studio.random.uniform(0.09, 0.2));
  pose.left = pose.right = hand;
  KeySequence s(pose);
  s.at(0.0);
  s.then(1.5);
  s.then(1.5);
  return {studio.play(s, 0.015)};
}
RawMotion tPose(Studio& studio) {
  return hold(studio, kTPose);
}
RawMotion handsOnHips(Studio& studio) {
  return hold(studio, kOnHip);
}
RawMotion overhead(Studio& studio) {
  return hold(studio, kOverhead);
}
RawMotion atease(Studio& studio) {
  return hold(studio, kAtSide);
}
RawMotion forward(Studio& studio) {
  return hold(studio, kForward);
}
constexpr std::array kRecipes = {Recipe{"t_pose", 2, &tPose}, Recipe{"hips", 1, &handsOnHips},
                                 Recipe{"overhead", 1, &overhead}, Recipe{"ease", 1, &atease},
                                 Recipe{"forward", 1, &forward}};

}  // namespace

std::span<const Recipe> bodyRecipes() {
  return kRecipes;
}
std::span<const Recipe> jumpRecipes() {
  return {};
}
std::span<const Recipe> gestureRecipes() {
  return {};
}
std::span<const Recipe> drawingRecipes() {
  return {};
}
std::span<const Recipe> sportsRecipes() {
  return {};
}
std::span<const Recipe> everydayRecipes() {
  return {};
}
std::span<const Recipe> danceRecipes() {
  return {};
}

}  // namespace depthmocap

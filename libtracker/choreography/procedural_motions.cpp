#include "libtracker/choreography/procedural_motions.h"

#include <algorithm>
#include <array>

#include "depthmocap/error.h"
#include "libtracker/choreography/recipe.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr std::array kSubjects = {&locomotionRecipes, &jumpRecipes,   &fightingRecipes, &gestureRecipes,
                                  &drawingRecipes,    &sportsRecipes, &everydayRecipes, &sittingRecipes,
                                  &exerciseRecipes,   &stanceRecipes, &danceRecipes};

std::string variantName(std::string_view name, int variant) {
  return variant == 0 ? std::string(name) : std::string(name) + "_" + std::to_string(variant + 1);
}

// FNV-1a: every motion draws from a random stream of its own.
std::uint64_t streamOf(std::string_view name) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

MotionClip perform(const Recipe& recipe, int variant, std::uint64_t seed) {
  MotionClip clip;
  clip.name = variantName(recipe.name, variant);
  clip.fps = kMotionFps;
  const Skeleton skeleton = makeSkeleton(clip.lengths);
  Random random(seed, streamOf(clip.name));
  Studio studio{skeleton, random, variant};
  clip.poses = finishMotion(skeleton, recipe.make(studio), random);
  if (variant % 2 == 1) {
    for (Pose& q : clip.poses) q = mirroredPose(q);
  }
  return clip;
}

template <typename Visit>
void forEachMotion(Visit&& visit) {
  for (const auto subject : kSubjects) {
    for (const Recipe& recipe : subject()) {
      for (int variant = 0; variant < recipe.variants; ++variant) visit(recipe, variant);
    }
  }
}

std::size_t commonPrefix(std::string_view a, std::string_view b) {
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

}  // namespace

std::vector<std::string> proceduralMotionNames() {
  std::vector<std::string> names;
  forEachMotion([&](const Recipe& recipe, int variant) { names.push_back(variantName(recipe.name, variant)); });
  return names;
}

MotionClip proceduralMotion(std::string_view name, std::uint64_t seed) {
  MotionClip clip;
  bool found = false;
  forEachMotion([&](const Recipe& recipe, int variant) {
    if (found || variantName(recipe.name, variant) != name) return;
    clip = perform(recipe, variant, seed);
    found = true;
  });
  if (found) return clip;
  const auto names = proceduralMotionNames();
  const auto nearest = std::max_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
    return commonPrefix(a, name) < commonPrefix(b, name);
  });
  throw Error("no such procedural motion", std::string(name), "did you mean " + *nearest + "?");
}

std::vector<MotionClip> proceduralMotions(std::uint64_t seed) {
  std::vector<MotionClip> clips;
  forEachMotion([&](const Recipe& recipe, int variant) { clips.push_back(perform(recipe, variant, seed)); });
  return clips;
}

}  // namespace depthmocap

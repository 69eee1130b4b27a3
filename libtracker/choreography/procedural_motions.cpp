#include "libtracker/choreography/procedural_motions.h"

#include <algorithm>
#include <array>
#include <functional>

#include "depthmocap/error.h"
#include "libtracker/choreography/motion_library.h"
#include "libtracker/choreography/motion_player.h"
#include "libtracker/choreography/recipe.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr std::array kSubjects = {&locomotionRecipes};

std::string variantName(std::string_view name, int variant) {
  return variant == 0 ? std::string(name) : std::string(name) + "_" + std::to_string(variant + 1);
}

// FNV-1a: every motion draws from a random stream of its own.
std::uint64_t streamOf(std::string_view name) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

template <typename Make>
MotionClip perform(std::string_view name, int variant, std::uint64_t seed, Make&& make) {
  MotionClip clip;
  clip.name = variantName(name, variant);
  clip.fps = kMotionFps;
  const Skeleton skeleton = makeSkeleton(clip.lengths);
  Random random(seed, streamOf(clip.name));
  clip.poses = finishMotion(skeleton, make(skeleton, random), random);
  if (variant % 2 == 1) {
    for (Pose& q : clip.poses) q = mirroredPose(q);
  }
  return clip;
}

// One variant of a motion.
using Perform = std::function<MotionClip(std::uint64_t seed)>;

template <typename Visit>
void forEachMotion(Visit&& visit) {
  const auto visitVariants = [&](std::string_view name, int variants, const auto& make) {
    for (int variant = 0; variant < variants; ++variant) {
      visit(variantName(name, variant), [=](std::uint64_t seed) {
        return perform(name, variant, seed,
                       [&](const Skeleton& skeleton, Random& random) { return make(skeleton, random, variant); });
      });
    }
  };
  for (const auto subject : kSubjects) {
    for (const Recipe& recipe : subject()) {
      visitVariants(recipe.name, recipe.variants, [&](const Skeleton& skeleton, Random& random, int variant) {
        Studio studio{skeleton, random, variant};
        return recipe.make(studio);
      });
    }
  }
  for (const MotionFile& file : motionLibrary()) {
    for (const MotionScript& motion : file.motions) {
      visitVariants(motion.name, motion.variants, [&](const Skeleton& skeleton, Random& random, int variant) {
        return playMotion(motion, file.places, variant, skeleton, random);
      });
    }
  }
}

std::size_t commonPrefix(std::string_view a, std::string_view b) {
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

}  // namespace

std::vector<std::string> proceduralMotionNames() {
  std::vector<std::string> names;
  forEachMotion([&](const std::string& name, const Perform&) { names.push_back(name); });
  return names;
}

MotionClip proceduralMotion(std::string_view name, std::uint64_t seed) {
  MotionClip clip;
  bool found = false;
  forEachMotion([&](const std::string& known, const Perform& performIt) {
    if (found || known != name) return;
    clip = performIt(seed);
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
  forEachMotion([&](const std::string&, const Perform& performIt) { clips.push_back(performIt(seed)); });
  return clips;
}

}  // namespace depthmocap

#include "libtracker/choreography/procedural_motions.h"

#include <algorithm>

#include "depthmocap/error.h"
#include "libtracker/choreography/motion_finish.h"
#include "libtracker/choreography/motion_library.h"
#include "libtracker/choreography/motion_player.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

// One variant of a motion.
struct MotionVariant {
  const MotionFile* file;
  const MotionScript* motion;
  int variant;

  [[nodiscard]] std::string name() const {
    return variant == 0 ? motion->name : motion->name + "_" + std::to_string(variant + 1);
  }
};

std::vector<MotionVariant> allVariants() {
  std::vector<MotionVariant> all;
  for (const MotionFile& file : motionLibrary()) {
    for (const MotionScript& motion : file.motions) {
      for (int variant = 0; variant < motion.variants; ++variant) all.push_back({&file, &motion, variant});
    }
  }
  return all;
}

// FNV-1a: every motion draws from a random stream of its own.
std::uint64_t streamOf(std::string_view name) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

MotionClip perform(const MotionVariant& one, std::uint64_t seed) {
  MotionClip clip;
  clip.name = one.name();
  clip.fps = kMotionFps;
  const Skeleton skeleton = makeSkeleton(clip.lengths);
  Random random(seed, streamOf(clip.name));
  const int variant = one.variant;
  RawMotion raw = playMotion(*one.motion, one.file->places, variant, skeleton, random);
  clip.poses = finishMotion(skeleton, std::move(raw), random);
  if (variant % 2 == 1) {
    for (Pose& q : clip.poses) q = mirroredPose(q);
  }
  return clip;
}

std::size_t commonPrefix(std::string_view a, std::string_view b) {
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

}  // namespace

std::vector<std::string> proceduralMotionNames() {
  std::vector<std::string> names;
  for (const MotionVariant& one : allVariants()) names.push_back(one.name());
  return names;
}

MotionClip proceduralMotion(std::string_view name, std::uint64_t seed) {
  for (const MotionVariant& one : allVariants()) {
    if (one.name() == name) return perform(one, seed);
  }
  const auto names = proceduralMotionNames();
  const auto nearest = std::max_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
    return commonPrefix(a, name) < commonPrefix(b, name);
  });
  throw Error("no such procedural motion", std::string(name), "did you mean " + *nearest + "?");
}

std::vector<MotionClip> proceduralMotions(std::uint64_t seed) {
  std::vector<MotionClip> clips;
  for (const MotionVariant& one : allVariants()) clips.push_back(perform(one, seed));
  return clips;
}

}  // namespace depthmocap

#pragma once
#include <cstddef>
#include <vector>

#include "libtracker/motion/source_motion.h"
#include "libtracker/motion/text_scanner.h"

namespace depthmocap {

// What a value of a BVH row does: 0..2 position x y z, 3..5 rotation about x y z, 6..8 scale x y z (not used).
using BvhChannel = int;
inline constexpr BvhChannel kBvhRotation = 3;
inline constexpr BvhChannel kBvhScale = 6;

// The hierarchy of a BVH file. Several ROOTs are several bones without parent.
struct BvhHierarchy {
  std::vector<MotionBone> bones;
  std::vector<std::vector<BvhChannel>> channels;  // one list per bone
  std::size_t channel_count = 0;                  // of all bones: values of a row
};

// Takes everything from HIERARCHY to MOTION. Unknown keywords are skipped with their line. Error with file:line.
BvhHierarchy readBvhHierarchy(TextScanner& text);

// Which bones belong to the ROOT with the most bones, the first of equals: the body, where others are props or second
// persons.
std::vector<bool> largestTree(const std::vector<MotionBone>& bones);

}  // namespace depthmocap

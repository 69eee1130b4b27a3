#pragma once
#include <array>
#include <cstddef>
#include <filesystem>

#include "depthmocap/joints.h"
#include "libtracker/classify/forest.h"

namespace depthmocap {

// How many joints of a reference skeleton lie on a pixel of a part that meets at this joint: a measure of the
// classifier on real images, of which nobody knows the parts. Shoulder: shoulder or upper arm; elbow: upper or lower
// arm; wrist: lower arm; hip: waist or upper leg; knee: upper or lower leg; ankle: lower leg; head; neck: neck, head or
// torso. Sides count. Pelvis, spine and toes are not looked at.
struct JointHits {
  std::array<int, kJointCount> hit{};
  std::array<int, kJointCount> all{};

  void add(const JointHits& other);
  // Share of a joint's that were hit, [0, 1]; 0 where there are none.
  [[nodiscard]] double shareOf(Joint joint) const;
  // Mean of the shares of the joints that were looked at.
  [[nodiscard]] double meanShare() const;
};

// Of every `step`-th frame (by its number) of a recording without background whose reference/joints.csv says
// `tracking`; a joint is hit by any pixel of the 5x5 around it. Each image is classified by itself, every pixel. Throws
// Error.
JointHits measureJointHits(const Forest& forest, const std::filesystem::path& recording, int step);

}  // namespace depthmocap

#include "libtracker/tracker/joint_confidence.h"

#include <algorithm>
#include <cmath>

namespace depthmocap {
namespace {

// The parts that meet at each joint, in the order of Joint. None fills the list.
constexpr std::array<std::array<Part, 3>, kJointCount> kPartsAtJoint = {{
    {Part::LeftWaist, Part::RightWaist, Part::None},
    {Part::Torso, Part::None, Part::None},
    {Part::Neck, Part::Torso, Part::None},
    {Part::Head, Part::None, Part::None},
    {Part::LeftShoulder, Part::LeftUpperArm, Part::None},
    {Part::LeftUpperArm, Part::LeftLowerArm, Part::None},
    {Part::LeftLowerArm, Part::None, Part::None},
    {Part::RightShoulder, Part::RightUpperArm, Part::None},
    {Part::RightUpperArm, Part::RightLowerArm, Part::None},
    {Part::RightLowerArm, Part::None, Part::None},
    {Part::LeftWaist, Part::LeftUpperLeg, Part::None},
    {Part::LeftUpperLeg, Part::LeftLowerLeg, Part::None},
    {Part::LeftLowerLeg, Part::None, Part::None},
    {Part::LeftLowerLeg, Part::None, Part::None},
    {Part::RightWaist, Part::RightUpperLeg, Part::None},
    {Part::RightUpperLeg, Part::RightLowerLeg, Part::None},
    {Part::RightLowerLeg, Part::None, Part::None},
    {Part::RightLowerLeg, Part::None, Part::None},
}};

constexpr double kResidualScale_m = 0.10;  // a marker this far from the solved pose counts 1/e

}  // namespace

Eigen::Matrix<double, kJointCount, 1> jointConfidence(const MarkerSet& seen, const MarkerSet& solved) {
  Eigen::Matrix<double, kJointCount, 1> confidence = Eigen::Matrix<double, kJointCount, 1>::Zero();
  for (int joint = 0; joint < kJointCount; ++joint) {
    for (Part part : kPartsAtJoint[static_cast<std::size_t>(joint)]) {
      if (part == Part::None) continue;
      const int i = partIndex(part);
      if (!seen.seen(i)) continue;
      const double distance = (seen.position.col(i) - solved.position.col(i)).norm();
      confidence[joint] = std::max(confidence[joint], seen.confidence[i] * std::exp(-distance / kResidualScale_m));
    }
  }
  return confidence.cwiseMin(1.0);
}

}  // namespace depthmocap

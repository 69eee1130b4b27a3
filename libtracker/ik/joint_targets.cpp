#include "depthmocap/joint_targets.h"

#include <algorithm>

#include <fmt/format.h>

namespace depthmocap {

int JointTargets::count() const {
  return static_cast<int>(std::count(given.begin(), given.end(), true));
}

std::string JointTargets::add(Joint joint, const Eigen::Vector3d& p_world_target) {
  const auto index = static_cast<std::size_t>(joint);
  if (given[index]) return fmt::format("joint '{}' is given twice for one pose", kJointNames[index]);
  if (!p_world_target.allFinite()) return "a coordinate is not a finite number";
  if (p_world_target.cwiseAbs().maxCoeff() > kFarthestTarget_m) {
    return fmt::format("a target more than {} m from the origin; coordinates are in metres", kFarthestTarget_m);
  }
  for (std::size_t other = 0; other < kJointCount; ++other) {
    const double distance_m = (p_world.col(static_cast<int>(other)) - p_world_target).norm();
    if (given[other] && distance_m > kWidestTargets_m) {
      return fmt::format("joints '{}' and '{}' are {:.1f} m apart, which is no person; coordinates are in metres",
                         kJointNames[other], kJointNames[index], distance_m);
    }
  }
  p_world.col(static_cast<int>(joint)) = p_world_target;
  given[index] = true;
  return {};
}

std::optional<Joint> jointNamed(std::string_view name) {
  const auto* const found = std::find(kJointNames.begin(), kJointNames.end(), name);
  if (found == kJointNames.end()) return std::nullopt;
  return static_cast<Joint>(found - kJointNames.begin());
}

}  // namespace depthmocap

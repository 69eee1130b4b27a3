#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "depthmocap/export.h"
#include "depthmocap/joints.h"

namespace depthmocap {

// Where some joints of one body should be: the input of inverse kinematics.
struct DEPTHMOCAP_API JointTargets {
  JointPositions p_world = JointPositions::Zero();  // [m] y up; the columns of the joints that are given
  std::array<bool, kJointCount> given{};
  // (> 0) of each joint's distance, for IkMethod::Lm: 1, or less where a joint may stay off its target.
  std::array<double, kJointCount> weight = [] {
    std::array<double, kJointCount> ones{};
    ones.fill(1.0);
    return ones;
  }();

  [[nodiscard]] bool has(Joint joint) const { return given[static_cast<std::size_t>(joint)]; }
  [[nodiscard]] int count() const;
  // Adds a target [m]. Empty, or why it is refused: given before, not finite, farther than kFarthestTarget_m from the
  // origin, or farther than kWidestTargets_m from another target, which no person is (millimetres taken for metres).
  std::string add(Joint joint, const Eigen::Vector3d& p_world_target);
};

inline constexpr double kFarthestTarget_m = 100.0;
inline constexpr double kWidestTargets_m = 4.0;

// The joint of this name (kJointNames); nothing if there is none.
DEPTHMOCAP_API std::optional<Joint> jointNamed(std::string_view name);

}  // namespace depthmocap

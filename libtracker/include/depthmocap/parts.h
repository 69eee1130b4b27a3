#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace depthmocap {

// The 15 body parts of the classifier (Su, Chai, Xia 2016, section 3.1), numbered as in a label image.
// Left and right are the actor's own. Lower arm includes the hand, lower leg the foot.
enum class Part : std::uint8_t {
  None = 0,
  Head,
  Neck,
  LeftShoulder,
  RightShoulder,
  LeftUpperArm,
  RightUpperArm,
  LeftLowerArm,
  RightLowerArm,
  Torso,
  LeftWaist,
  RightWaist,
  LeftUpperLeg,
  RightUpperLeg,
  LeftLowerLeg,
  RightLowerLeg,
};

inline constexpr int kPartCount = 15;  // without None; a part's index in an array of 15 is its number - 1

inline constexpr std::array<std::string_view, kPartCount + 1> kPartNames = {"none",
                                                                            "head",
                                                                            "neck",
                                                                            "left_shoulder",
                                                                            "right_shoulder",
                                                                            "left_upper_arm",
                                                                            "right_upper_arm",
                                                                            "left_lower_arm",
                                                                            "right_lower_arm",
                                                                            "torso",
                                                                            "left_waist",
                                                                            "right_waist",
                                                                            "left_upper_leg",
                                                                            "right_upper_leg",
                                                                            "left_lower_leg",
                                                                            "right_lower_leg"};

// The same part on the other side; parts without a side are their own mirror.
constexpr Part mirrored(Part part) {
  const auto n = static_cast<int>(part);
  if (n < 3 || part == Part::Torso) return part;
  const bool after_torso = n > static_cast<int>(Part::Torso);
  const bool is_left = after_torso ? n % 2 == 0 : n % 2 == 1;
  return static_cast<Part>(is_left ? n + 1 : n - 1);
}

constexpr int partIndex(Part part) {
  return static_cast<int>(part) - 1;
}
constexpr Part partAt(int index) {
  return static_cast<Part>(index + 1);
}

}  // namespace depthmocap

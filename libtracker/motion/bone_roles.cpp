#include "libtracker/motion/bone_roles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/motion/text_scanner.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

// Of a side's bone in each naming, best first; "%" stands for "l" or "left" and "r" or "right".
using Names = std::span<const std::string_view>;
constexpr std::string_view kHumerus[] = {"%humerus", "%arm", "%upperarm", "%uparm", "%shldr", "%shoulder"};
constexpr std::string_view kRadius[] = {"%radius", "%forearm", "%lowerarm", "%lowarm", "%elbow"};
constexpr std::string_view kFingerBase[] = {"%fingerbase"};
constexpr std::string_view kHand[] = {"%hand"};
constexpr std::string_view kWrist[] = {"%wrist"};
constexpr std::string_view kFemur[] = {"%femur", "%upleg", "%upperleg", "%thigh", "%hip"};
constexpr std::string_view kTibia[] = {"%tibia", "%leg", "%lowerleg", "%lowleg", "%shin", "%knee"};
constexpr std::string_view kFoot[] = {"%foot", "%ankle"};
constexpr std::string_view kToe[] = {"%toes", "%toebase", "%toe"};

// Lower case, without the name space ("mixamorig:") and without blanks, dots, dashes and underscores.
std::string plainName(std::string_view name) {
  const auto colon = name.rfind(':');
  if (colon != std::string_view::npos) name.remove_prefix(colon + 1);
  std::string plain = lowerCase(name);
  std::erase_if(plain, [](char c) { return c == ' ' || c == '_' || c == '-' || c == '.'; });
  return plain;
}

class RoleFinder {
 public:
  RoleFinder(const std::vector<MotionBone>& bones, const std::string& where)
      : bones_(bones), where_(where), rest_(restFrame(bones)) {
    for (const MotionBone& bone : bones) names_.push_back(plainName(bone.name));
  }

  BoneRoles find() {
    BoneRoles roles;
    roles.left = side("l", "left");
    roles.right = side("r", "right");
    roles.head = need(indexOf("head"), "head");
    roles.pelvis = commonAncestor(roles.left.femur, roles.right.femur);
    roles.thorax = commonAncestor(commonAncestor(roles.left.humerus, roles.right.humerus), roles.head);
    roles.neck = neck(roles);
    roles.head_center = headCenter(roles);
    const RestTrunk trunk = restTrunk(rest_, roles);
    if ((trunk.neck - trunk.hips).norm() < 1e-9) throw Error("the skeleton's trunk has no length", where_);
    roles.spine = spine(roles, trunk);
    return roles;
  }

 private:
  [[nodiscard]] int indexOf(std::string_view plain) const {
    const auto found = std::find(names_.begin(), names_.end(), plain);
    return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
  }

  [[nodiscard]] int sideBone(Names patterns, std::string_view short_side, std::string_view long_side) const {
    for (const std::string_view pattern : patterns) {
      for (const std::string_view side : {short_side, long_side}) {
        const int index = indexOf(std::string(side) + std::string(pattern.substr(1)));
        if (index >= 0) return index;
      }
    }
    return -1;
  }

  int need(int index, std::string_view part) const {
    if (index >= 0) return index;
    throw Error(fmt::format("the skeleton has no bone that can be the {}", part), where_,
                "known names: ASF (lhumerus), LeftArm, lShldr and their like");
  }

  // The end of a limb: the origin of the bone of that name, or the tip of the bone before.
  [[nodiscard]] SourcePoint end(int bone, int before, std::string_view part) const {
    if (bone >= 0) return {bone, Vector3d::Zero()};
    const MotionBone& limb = bones_[static_cast<std::size_t>(before)];
    need(limb.has_tip ? before : -1, part);
    return {before, limb.tip};
  }

  // ASF skeletons divide the forearm: radius, then a bone "wrist" half as long that only pronates, then the hand. Where
  // the palms stand on the floor (cartwheels, CMU 49_06 to 49_08), radius ends 6 cm above it and the "wrist" bone 3 cm
  // below: the wrist's centre is half way between. The cgspeed BVH files of the same motions leave the "wrist" bone
  // out.
  [[nodiscard]] SourcePoint wrist(std::string_view short_side, std::string_view long_side, int radius) const {
    constexpr double kWristBeyondRadius = 0.25;
    const int hand = sideBone(kHand, short_side, long_side);
    const int wrist = sideBone(kWrist, short_side, long_side);
    const int finger_base = sideBone(kFingerBase, short_side, long_side);
    if (wrist >= 0 && bones_[static_cast<std::size_t>(wrist)].has_tip && hand >= 0 && parentOf(hand) == wrist) {
      return {wrist, 0.5 * bones_[static_cast<std::size_t>(wrist)].tip};
    }
    if (finger_base >= 0 && parentOf(finger_base) == hand && parentOf(hand) == radius &&
        origin(finger_base) == origin(hand)) {
      return {radius, (1.0 + kWristBeyondRadius) * bones_[static_cast<std::size_t>(hand)].offset};
    }
    return end(wrist >= 0 ? wrist : hand, radius, "hand");
  }

  [[nodiscard]] BoneRoles::Side side(std::string_view short_side, std::string_view long_side) const {
    const auto named = [&](Names patterns, std::string_view part) {
      return need(sideBone(patterns, short_side, long_side), fmt::format("{} {}", long_side, part));
    };
    BoneRoles::Side side;
    side.humerus = named(kHumerus, "upper arm");
    side.radius = named(kRadius, "lower arm");
    side.femur = named(kFemur, "upper leg");
    side.tibia = named(kTibia, "lower leg");
    side.foot = named(kFoot, "foot");
    side.wrist = wrist(short_side, long_side, side.radius);
    side.toe = end(sideBone(kToe, short_side, long_side), side.foot, "toe");
    return side;
  }

  [[nodiscard]] int parentOf(int bone) const { return bones_[static_cast<std::size_t>(bone)].parent; }
  [[nodiscard]] const Vector3d& origin(int bone) const { return rest_.position[static_cast<std::size_t>(bone)]; }

  // Parents stand before children, so the larger index cannot be the ancestor of the smaller one.
  [[nodiscard]] int commonAncestor(int a, int b) const {
    while (a != b) (a > b ? a : b) = parentOf(std::max(a, b));
    return a;
  }

  [[nodiscard]] int neck(const BoneRoles& roles) const {
    std::vector<int> chain;  // head first
    for (int bone = roles.head; bone != roles.thorax && bone >= 0; bone = parentOf(bone)) chain.push_back(bone);
    const Vector3d hips = 0.5 * (origin(roles.left.femur) + origin(roles.right.femur));
    const Vector3d shoulders = 0.5 * (origin(roles.left.humerus) + origin(roles.right.humerus));
    const Vector3d up = (origin(roles.head) - hips).normalized();
    for (auto bone = chain.rbegin(); bone != chain.rend(); ++bone) {
      if (up.dot(origin(*bone) - shoulders) >= 0) return *bone;
    }
    return roles.head;
  }

  // Half way to the top of the head where the file gives it, else at the height of the bones that hang on the head
  // (eyes); without either, at an adult's share of the trunk above the head's joint.
  [[nodiscard]] Vector3d headCenter(const BoneRoles& roles) const {
    const MotionBone& head = bones_[static_cast<std::size_t>(roles.head)];
    if (head.has_tip && head.tip.norm() > 0) return 0.5 * head.tip;
    const int crown = indexOf("headtopend");
    if (crown >= 0 && parentOf(crown) == roles.head) return 0.5 * bones_[static_cast<std::size_t>(crown)].offset;
    const RestTrunk trunk = restTrunk(rest_, roles);
    const Vector3d up = trunk.axes.col(1);
    double height = 0;
    int children = 0;
    for (const MotionBone& bone : bones_) {
      if (bone.parent != roles.head) continue;
      height += up.dot(bone.offset);
      ++children;
    }
    constexpr double kCenterPerTrunk = 0.15;
    return up * (children > 0 ? height / children : kCenterPerTrunk * (trunk.neck - trunk.hips).norm());
  }

  [[nodiscard]] int spine(const BoneRoles& roles, const RestTrunk& trunk) const {
    constexpr double kSpineShare = 0.35;
    const double length = (trunk.neck - trunk.hips).norm();
    int best = -1;
    double best_distance = 0.25;  // of the trunk: a joint farther from the share is no joint of the middle
    for (int bone = roles.thorax; bone != roles.pelvis && bone >= 0; bone = parentOf(bone)) {
      const double share = trunk.axes.col(1).dot(origin(bone) - trunk.hips) / length;
      const double distance = std::abs(share - kSpineShare);
      if (distance < best_distance) {
        best = bone;
        best_distance = distance;
      }
    }
    return best;
  }

  const std::vector<MotionBone>& bones_;
  const std::string& where_;
  GlobalFrame rest_;
  std::vector<std::string> names_;
};

}  // namespace

BoneRoles findBoneRoles(const std::vector<MotionBone>& bones, const std::string& where) {
  return RoleFinder(bones, where).find();
}

RestTrunk restTrunk(const GlobalFrame& rest, const BoneRoles& roles) {
  const auto origin = [&](int bone) -> const Vector3d& { return rest.position[static_cast<std::size_t>(bone)]; };
  RestTrunk trunk;
  trunk.hips = 0.5 * (origin(roles.left.femur) + origin(roles.right.femur));
  trunk.neck = origin(roles.neck);
  const Vector3d line = trunk.neck - trunk.hips;
  Eigen::Index axis = 0;
  line.cwiseAbs().maxCoeff(&axis);
  const Vector3d up = line[axis] < 0 ? Vector3d(-Vector3d::Unit(axis)) : Vector3d(Vector3d::Unit(axis));
  const Vector3d across = origin(roles.left.femur) - origin(roles.right.femur);
  const Vector3d forward = across.cross(up).normalized();
  trunk.axes << up.cross(forward), up, forward;
  return trunk;
}

double detectMetresPerUnit(const GlobalFrame& rest, const BoneRoles& roles, const std::string& where) {
  constexpr double kAdult = 1.4;
  constexpr double kFactor = 1.6;
  constexpr std::array<double, 5> kUnits = {1.0, 0.01, 0.001, 0.0254, 0.0254 / 0.45};
  const auto origin = [&](int bone) -> const Vector3d& { return rest.position[static_cast<std::size_t>(bone)]; };
  const auto& leg = roles.left;
  const RestTrunk trunk = restTrunk(rest, roles);
  const double size = (origin(leg.tibia) - origin(leg.femur)).norm() + (origin(leg.foot) - origin(leg.tibia)).norm() +
                      (trunk.neck - trunk.hips).norm();
  const auto distance = [&](double unit) { return std::abs(std::log(size * unit / kAdult)); };
  const double best =
      *std::min_element(kUnits.begin(), kUnits.end(), [&](double a, double b) { return distance(a) < distance(b); });
  if (!(distance(best) < std::log(kFactor))) {
    throw Error(fmt::format("cannot tell the unit of length: legs and trunk measure {:.4g} together", size), where,
                "give the unit in metres");
  }
  return best;
}

}  // namespace depthmocap

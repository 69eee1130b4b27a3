#include "libtracker/motion/bone_roles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

class RoleFinder {
 public:
  RoleFinder(const std::vector<MotionBone>& bones, const NamedBones& named, const std::string& where)
      : bones_(bones), named_(named), where_(where), rest_(restFrame(bones)) {}

  BoneRoles find() {
    BoneRoles roles;
    // Each side looks at both thighs.
    need(named_.left.femur, "left upper leg");
    need(named_.right.femur, "right upper leg");
    roles.left = side(named_.left, "left");
    roles.right = side(named_.right, "right");
    roles.head = need(named_.head, "head");
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
  int need(int index, std::string_view part) const {
    if (index >= 0) return index;
    throw Error(fmt::format("the skeleton has no bone that can be the {}", part), where_,
                "--bones MAP.json says which bone is which");
  }

  [[nodiscard]] const MotionBone& bone(int index) const { return bones_[static_cast<std::size_t>(index)]; }

  // The end of a limb: the origin of the bone of that name, or the tip of the bone before, or else a point at an
  // adult's share of the bone before that one.
  [[nodiscard]] SourcePoint end(int end_bone, int before, const Vector3d& guess) const {
    if (end_bone >= 0) return {end_bone, Vector3d::Zero()};
    const MotionBone& limb = bone(before);
    return {before, limb.has_tip && limb.tip.norm() > 0 ? limb.tip : guess};
  }

  // ASF skeletons divide the forearm: radius, then a bone "wrist" half as long that only pronates, then the hand. Where
  // the palms stand on the floor (cartwheels, CMU 49_06 to 49_08), radius ends 6 cm above it and the "wrist" bone 3 cm
  // below: the wrist's centre is half way between. The cgspeed BVH files of the same motions leave the "wrist" bone
  // out.
  [[nodiscard]] SourcePoint wrist(const NamedBones::Side& s) const {
    constexpr double kWristBeyondRadius = 0.25;
    if (s.wrist >= 0 && bone(s.wrist).has_tip && s.hand >= 0 && parentOf(s.hand) == s.wrist) {
      return {s.wrist, 0.5 * bone(s.wrist).tip};
    }
    if (s.finger_base >= 0 && parentOf(s.finger_base) == s.hand && parentOf(s.hand) == s.radius &&
        origin(s.finger_base) == origin(s.hand)) {
      return {s.radius, (1.0 + kWristBeyondRadius) * bone(s.hand).offset};
    }
    const BoneLengths adult;
    const Vector3d lower_arm = adult.lower_arm / adult.upper_arm * (origin(s.radius) - origin(s.humerus));
    return end(s.wrist >= 0 ? s.wrist : s.hand, s.radius, lower_arm);
  }

  [[nodiscard]] BoneRoles::Side side(const NamedBones::Side& s, std::string_view name) const {
    const auto named = [&](int index, std::string_view part) { return need(index, fmt::format("{} {}", name, part)); };
    BoneRoles::Side side;
    side.humerus = named(s.humerus, "upper arm");
    side.radius = named(s.radius, "lower arm");
    side.femur = named(s.femur, "upper leg");
    side.tibia = named(s.tibia, "lower leg");
    side.foot = s.foot;
    side.wrist = wrist(s);
    const BoneLengths adult;
    const Vector3d thigh = origin(side.tibia) - origin(side.femur);
    side.ankle = end(s.foot, side.tibia, adult.lower_leg / adult.upper_leg * thigh);
    side.toe = toe(s);
    return side;
  }

  // Feet without toes and tip point forward: an adult's foot for the leg, the toe near the floor.
  [[nodiscard]] SourcePoint toe(const NamedBones::Side& s) const {
    constexpr double kDrop = 0.5;  // ankle above toe against their distance along the floor
    const BoneLengths adult;
    const Vector3d thigh = origin(s.tibia) - origin(s.femur);
    const Vector3d across = origin(named_.left.femur) - origin(named_.right.femur);
    const Vector3d forward = thigh.cross(across).normalized();
    const Vector3d guess =
        (forward + kDrop * thigh.normalized()).normalized() * (adult.foot / adult.upper_leg * thigh.norm());
    if (s.foot >= 0) return end(s.toe, s.foot, guess);
    const MotionBone& shin = bone(s.tibia);
    return {s.tibia, (shin.has_tip ? shin.tip : Vector3d(adult.lower_leg / adult.upper_leg * thigh)) + guess};
  }

  [[nodiscard]] int parentOf(int bone) const { return this->bone(bone).parent; }
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
    if (named_.crown >= 0 && parentOf(named_.crown) == roles.head) return 0.5 * bone(named_.crown).offset;
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
  const NamedBones& named_;
  const std::string& where_;
  GlobalFrame rest_;
};

}  // namespace

BoneRoles findBoneRoles(const std::vector<MotionBone>& bones, const NamedBones& named, const std::string& where) {
  return RoleFinder(bones, named, where).find();
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
  constexpr std::array<double, 7> kUnits = {1.0, 0.3048, 0.1, 0.01, 0.001, 0.0254, 0.0254 / 0.45};
  const auto origin = [&](int bone) -> const Vector3d& { return rest.position[static_cast<std::size_t>(bone)]; };
  const auto& leg = roles.left;
  const RestTrunk trunk = restTrunk(rest, roles);
  const double size = (origin(leg.tibia) - origin(leg.femur)).norm() +
                      (rest.point(leg.ankle.bone, leg.ankle.p_bone) - origin(leg.tibia)).norm() +
                      (trunk.neck - trunk.hips).norm();
  const auto distance = [&](double unit) { return std::abs(std::log(size * unit / kAdult)); };
  const double best =
      *std::min_element(kUnits.begin(), kUnits.end(), [&](double a, double b) { return distance(a) < distance(b); });
  if (!(distance(best) < std::log(kFactor))) {
    throw Error(fmt::format("cannot tell the unit of length: legs and trunk measure {:.4g} together", size), where,
                "--unit says how many metres one unit is");
  }
  return best;
}

}  // namespace depthmocap

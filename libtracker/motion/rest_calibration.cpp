#include "libtracker/motion/rest_calibration.h"

#include <algorithm>
#include <cmath>

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}
std::size_t at(Joint joint) {
  return static_cast<std::size_t>(joint);
}

// The axis about which a limb's lower bone turns, in the upper bone's frame: mean over the frames of upper x lower,
// each weighted by the square of how far the limb is bent; positive about it is flexion of a knee. Zero if the limb
// never bends.
Vector3d meanHingeAxis(const SourceMotion& motion, int upper, int lower, const Vector3d& lower_end) {
  const Vector3d upper_direction = motion.bones[at(lower)].offset.normalized();
  Vector3d sum = Vector3d::Zero();
  for (const MotionFrame& frame : motion.frames) {
    Matrix3d R = frame.rotation[at(lower)].toRotationMatrix();
    for (int bone = motion.bones[at(lower)].parent; bone != upper && bone > 0; bone = motion.bones[at(bone)].parent) {
      R = frame.rotation[at(bone)].toRotationMatrix() * R;
    }
    const Vector3d normal = upper_direction.cross(R * lower_end.normalized());
    sum += normal * normal.norm();
  }
  constexpr double kLeastBend = 1e-4;  // mean sin^2
  const double least = kLeastBend * static_cast<double>(motion.frames.size());
  return sum.norm() > least ? Vector3d(sum.normalized()) : Vector3d::Zero();
}

}  // namespace

RestCalibration::RestCalibration(const SourceMotion& motion, const NamedBones& named, double metres_per_unit,
                                 const std::string& where)
    : metres_per_unit_(metres_per_unit) {
  const std::vector<MotionBone> bones = meanBones(motion);
  roles_ = findBoneRoles(bones, named, where);
  const GlobalFrame rest = restFrame(bones);
  const RestTrunk trunk = restTrunk(rest, roles_);
  R_ours_source_ = Eigen::Quaterniond::FromTwoVectors(trunk.axes.col(1), Vector3d::UnitY()).toRotationMatrix();
  measure(rest, trunk);
  mapJoints(rest, trunk);
  mapAxes(motion, rest, trunk);
}

void RestCalibration::measure(const GlobalFrame& rest, const RestTrunk& trunk) {
  const auto origin = [&](int bone) -> const Vector3d& { return rest.position[at(bone)]; };
  const auto point = [&](const SourcePoint& p) { return rest.point(p.bone, p.p_bone); };
  const auto both = [&](auto&& length) {
    return 0.5 * metres_per_unit_ * (length(roles_.left) + length(roles_.right));
  };
  using Side = BoneRoles::Side;
  const Vector3d up = trunk.axes.col(1);
  const BoneLengths adult;
  BoneLengths& l = lengths_;
  l.upper_arm = both([&](const Side& s) { return (origin(s.radius) - origin(s.humerus)).norm(); });
  l.lower_arm = both([&](const Side& s) { return (point(s.wrist) - origin(s.radius)).norm(); });
  l.upper_leg = both([&](const Side& s) { return (origin(s.tibia) - origin(s.femur)).norm(); });
  l.lower_leg = both([&](const Side& s) { return (point(s.ankle) - origin(s.tibia)).norm(); });
  l.foot = both([&](const Side& s) { return (point(s.toe) - point(s.ankle)).norm(); });
  l.shoulder_width = metres_per_unit_ * (origin(roles_.left.humerus) - origin(roles_.right.humerus)).norm();
  l.hip_width = metres_per_unit_ * (origin(roles_.left.femur) - origin(roles_.right.femur)).norm();
  l.shoulder_drop = both([&](const Side& s) { return up.dot(trunk.neck - origin(s.humerus)); });
  // Files do not agree on where a pelvis is: ours lies an adult's share of the leg above the hips.
  l.hip_drop = adult.hip_drop * (l.upper_leg + l.lower_leg) / (adult.upper_leg + adult.lower_leg);
  l.torso = metres_per_unit_ * (trunk.neck - trunk.hips).norm() - l.hip_drop;
  l.neck_to_head = metres_per_unit_ * (rest.point(roles_.head, roles_.head_center) - trunk.neck).norm();
  l.spine = roles_.spine < 0 ? l.torso * adult.spine / adult.torso
                             : metres_per_unit_ * up.dot(origin(roles_.spine) - trunk.hips) - l.hip_drop;
}

void RestCalibration::mapJoints(const GlobalFrame& rest, const RestTrunk& trunk) {
  const Vector3d up = trunk.axes.col(1);
  const auto rigidWith = [&](int bone, const Vector3d& p_rest) {
    return SourcePoint{bone, rest.rotation[at(bone)].transpose() * (p_rest - rest.position[at(bone)])};
  };
  const auto origin = [](int bone) { return SourcePoint{bone, Vector3d::Zero()}; };
  const Vector3d pelvis = trunk.hips + up * (lengths_.hip_drop / metres_per_unit_);
  joints_[at(Joint::Pelvis)] = rigidWith(roles_.pelvis, pelvis);
  joints_[at(Joint::Spine)] = roles_.spine < 0
                                  ? rigidWith(roles_.pelvis, pelvis + up * (lengths_.spine / metres_per_unit_))
                                  : origin(roles_.spine);
  joints_[at(Joint::Neck)] = rigidWith(roles_.thorax, trunk.neck);
  joints_[at(Joint::Head)] = rigidWith(roles_.head, trunk.neck + up * (lengths_.neck_to_head / metres_per_unit_));
  const auto side = [&](const BoneRoles::Side& s, Joint shoulder, Joint hip) {
    joints_[at(shoulder)] = origin(s.humerus);
    joints_[at(shoulder) + 1] = origin(s.radius);
    joints_[at(shoulder) + 2] = s.wrist;
    joints_[at(hip)] = origin(s.femur);
    joints_[at(hip) + 1] = origin(s.tibia);
    joints_[at(hip) + 2] = s.ankle;
    joints_[at(hip) + 3] = s.toe;
  };
  side(roles_.left, Joint::LeftShoulder, Joint::LeftHip);
  side(roles_.right, Joint::RightShoulder, Joint::RightHip);
}

void RestCalibration::mapAxes(const SourceMotion& motion, const GlobalFrame& rest, const RestTrunk& trunk) {
  axes_[0] = {roles_.pelvis, trunk.axes.col(2)};
  axes_[1] = {roles_.thorax, trunk.axes.col(0)};
  axes_[2] = {roles_.head, trunk.axes.col(0)};
  // `ours` is the limb's direction in our zero pose, `axis` its hinge there, `sign` whether flexion is positive about
  // it.
  const auto hinge = [&](int upper, int lower, const SourcePoint& end, const Vector3d& ours, const Vector3d& axis,
                         double sign) {
    const Vector3d lower_origin = rest.position[at(lower)];
    const Vector3d limb = trunk.axes.transpose() * (lower_origin - rest.position[at(upper)]);
    const Vector3d expected =
        (trunk.axes * Eigen::Quaterniond::FromTwoVectors(ours, limb).toRotationMatrix() * axis).normalized();
    const Vector3d lower_end = rest.point(end.bone, end.p_bone) - lower_origin;
    const Vector3d seen = sign * meanHingeAxis(motion, upper, lower, lower_end);
    constexpr double kCosineOfDoubt = 0.2;
    return AxisSource{upper, seen.dot(expected) > kCosineOfDoubt ? seen : expected};
  };
  const auto& r = roles_.right;
  const auto& l = roles_.left;
  axes_[3] = hinge(r.humerus, r.radius, r.wrist, -Vector3d::UnitX(), Vector3d::UnitY(), 1);
  axes_[4] = hinge(l.humerus, l.radius, l.wrist, Vector3d::UnitX(), Vector3d::UnitY(), -1);
  axes_[5] = hinge(r.femur, r.tibia, r.ankle, -Vector3d::UnitY(), Vector3d::UnitX(), 1);
  axes_[6] = hinge(l.femur, l.tibia, l.ankle, -Vector3d::UnitY(), Vector3d::UnitX(), 1);
}

void RestCalibration::targets(const GlobalFrame& frame, FitTargets& targets) const {
  for (std::size_t j = 0; j < kJointCount; ++j) {
    const SourcePoint& joint = joints_[j];
    targets.joints.col(static_cast<Eigen::Index>(j)) =
        metres_per_unit_ * (R_ours_source_ * frame.point(joint.bone, joint.p_bone));
  }
  for (std::size_t a = 0; a < kFitAxes.size(); ++a) {
    targets.axes[a] = R_ours_source_ * (frame.rotation[at(axes_[a].bone)] * axes_[a].direction);
  }
}

}  // namespace depthmocap

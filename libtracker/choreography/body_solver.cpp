#include "libtracker/choreography/body_solver.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "libtracker/choreography/easing.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Chosen by hand: no comparison of values is on record (docs/tuning.md).
// They make poses that look natural; no measured motion was fitted.

// [m] Distance of the heel behind the ankle.
constexpr double kHeelBehindAnkle = 0.05;
// [m] A foot lifted by less stands or is about to.
constexpr double kOnGround = 0.04;
// [rad] Least flexion of the knee: the leg is never quite straight.
constexpr double kMinKneeFlexion = 0.05;
// [rad] Flexion of a standing knee that is not locked.
constexpr double kEasyKneeFlexion = 0.13;
// [rad] Greatest flexion of the knee, 152 degrees.
constexpr double kMaxKneeFlexion = 2.65;
// Share of the leg's longest reach from which a foot in the air slows down towards its target.
constexpr double kSoftReach = 0.94;
// [m] A foot lifted by more need not meet its target.
constexpr double kFreeLift = 0.10;
// [rad] Distance that is kept from each joint limit.
constexpr double kLimitMargin = 0.01;
// Share of the foot's turn against the pelvis that comes from the hip; the ankle turns the rest.
constexpr double kKneeFollowsFoot = 0.85;

struct LegBones {
  Bone femur, tibia, foot;
};

LegBones legBones(Side side) {
  return side == Side::Left ? LegBones{Bone::LeftFemur, Bone::LeftTibia, Bone::LeftFoot}
                            : LegBones{Bone::RightFemur, Bone::RightTibia, Bone::RightFoot};
}

double legReach(const Skeleton& skeleton, double knee_flexion) {
  const double a = skeleton.lengths.upper_leg;
  const double b = skeleton.lengths.lower_leg;
  return std::sqrt(a * a + b * b + 2 * a * b * std::cos(knee_flexion));
}

Matrix3d rootRotation(const PelvisState& pelvis) {
  Pose q = Pose::Zero();
  q[kRootRx] = pelvis.lean;
  q[kRootRy] = pelvis.heading;
  q[kRootRz] = pelvis.tilt;
  return localRotation(Bone::Root, q);
}

Vector3d hipOffset(const Skeleton& skeleton, const BodyFrame& frame, Side side) {
  return rootRotation(frame.pelvis) * skeleton.offset[static_cast<std::size_t>(legBones(side).femur)];
}

Matrix3d footRotation(double heading, double pitch) {
  return (AngleAxisd(heading, Vector3d::UnitY()) * AngleAxisd(pitch, Vector3d::UnitX())).toRotationMatrix();
}

// The pitch at which the leg reaches the ankle: as given, or more where the leg is too short.
double reachablePitch(const Sole& sole, const FootState& foot, const Vector3d& hip, double reach) {
  const auto distance = [&](double pitch) { return (anklePosition(sole, foot, pitch) - hip).norm(); };
  if (distance(foot.pitch) <= reach || foot.heel_rise <= foot.pitch) return foot.pitch;
  double low = foot.pitch;
  double high = foot.heel_rise;
  if (distance(high) > reach) return high;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (distance(middle) > reach ? low : high) = middle;
  }
  return high;
}

// The foot's two DoFs so that its toe points along `toe` (unit, in the tibia's frame): Newton from the nearest swing.
void aimFoot(Bone bone, const Vector3d& toe_rest, const Matrix3d& R_tibia_foot, Pose& q) {
  setLocalRotation(bone, R_tibia_foot, q);
  const int i = kBoneDofs[static_cast<std::size_t>(bone)].first;
  const Vector3d wanted = R_tibia_foot * toe_rest;
  for (int iteration = 0; iteration < 2; ++iteration) {
    constexpr double kStep = 1e-6;
    const Vector3d now = localRotation(bone, q) * toe_rest;
    Eigen::Matrix<double, 3, 2> J;
    for (int k = 0; k < 2; ++k) {
      Pose moved = q;
      moved[i + k] += kStep;
      J.col(k) = (localRotation(bone, moved) * toe_rest - now) / kStep;
    }
    q.segment<2>(i) += (J.transpose() * J).ldlt().solve(J.transpose() * (wanted - now));
  }
}

// A foot in the air may miss its target a little: it slows down before the leg is straight instead of stopping there at
// once.
double reachedDistance(double wanted, double max_reach, double lift) {
  const double share = wanted / max_reach;
  if (share < kSoftReach) return wanted;
  const double soft = kSoftReach + (1.0 - kSoftReach) * std::tanh((share - kSoftReach) / (1.0 - kSoftReach));
  return max_reach * lerp(share, soft, smoothStep(lift / kFreeLift));
}

void solveLeg(const Skeleton& skeleton, const BodyFrame& frame, Side side, Pose& q) {
  const FootState& foot = frame.foot(side);
  const LegBones bones = legBones(side);
  const Sole sole = soleOf(skeleton);
  const Matrix3d R_root = rootRotation(frame.pelvis);
  const Vector3d hip = q.head<3>() + hipOffset(skeleton, frame, side);
  const double max_reach = legReach(skeleton, kMinKneeFlexion);
  const double pitch = reachablePitch(sole, foot, hip, max_reach);
  const Vector3d line = R_root.transpose() * (anklePosition(sole, foot, pitch) - hip);
  const double d =
      std::clamp(reachedDistance(line.norm(), max_reach, foot.lift), legReach(skeleton, kMaxKneeFlexion), max_reach);

  const double a = skeleton.lengths.upper_leg;
  const double b = skeleton.lengths.lower_leg;
  const double at_hip = std::acos(std::clamp((a * a + d * d - b * b) / (2 * a * d), -1.0, 1.0));
  const double knee = std::acos(std::clamp((d * d - a * a - b * b) / (2 * a * b), -1.0, 1.0));
  const double toe_turn = std::remainder(foot.heading - frame.pelvis.heading, 2 * std::numbers::pi);
  const double twist =
      std::clamp(kKneeFollowsFoot * toe_turn + sideSign(side) * foot.knee_out, -degrees(55), degrees(55));
  const Matrix3d R_swing = Eigen::Quaterniond::FromTwoVectors(-Vector3d::UnitY(), line).toRotationMatrix();
  const Matrix3d R_femur =
      R_swing * (AngleAxisd(twist, Vector3d::UnitY()) * AngleAxisd(-at_hip, Vector3d::UnitX())).toRotationMatrix();
  setLocalRotation(bones.femur, R_femur, q);
  q[kBoneDofs[static_cast<std::size_t>(bones.tibia)].first] = knee;
  const Matrix3d R_tibia = R_root * R_femur * localRotation(bones.tibia, q);
  aimFoot(bones.foot, sole.toe.normalized(), R_tibia.transpose() * footRotation(foot.heading, pitch), q);
}

void writeArm(Side side, const ArmAngles& arm, Pose& q) {
  const double s = sideSign(side);
  const bool left = side == Side::Left;
  const int clavicle = left ? kLclavicleRy : kRclavicleRy;
  const int humerus = left ? kLhumerusRx : kRhumerusRx;
  q.segment<2>(clavicle) = s * Eigen::Vector2d(arm.clavicle_y, arm.clavicle_z);
  q.segment<3>(humerus) = Vector3d(arm.twist, s * arm.swing_y, s * arm.swing_z);
  q[left ? kLradiusRy : kRradiusRy] = s * arm.elbow;
}

}  // namespace

Sole soleOf(const Skeleton& skeleton) {
  const BoneLengths& l = skeleton.lengths;
  const double ankle_height = standingPelvisHeight(skeleton) - l.hip_drop - l.upper_leg - l.lower_leg;
  const Vector3d& toe = skeleton.left_toe;
  return {ankle_height, toe, Vector3d(toe.x(), -ankle_height, toe.z()), Vector3d(0, -ankle_height, -kHeelBehindAnkle)};
}

double standingPelvisHeight(const Skeleton& skeleton) {
  // What statureOf() counts below the pelvis: it puts the ankle 0.17 of the lower leg above the floor.
  const BoneLengths& l = skeleton.lengths;
  BoneLengths legs_only = l;
  legs_only.torso = 0;
  legs_only.neck_to_head = 0;
  return statureOf(legs_only);
}

Vector3d anklePosition(const Sole& sole, const FootState& foot, double pitch) {
  const Vector3d flat(foot.x, foot.ground + foot.lift + sole.ankle_height, foot.z);
  const Vector3d& pivot = pitch > 0 ? sole.toe : sole.heel;
  return flat + footRotation(foot.heading, 0) * pivot - footRotation(foot.heading, pitch) * pivot;
}

Pose solveBody(const Skeleton& skeleton, const BodyFrame& frame) {
  Pose q = Pose::Zero();
  q.head<3>() = Vector3d(frame.pelvis.x, standingPelvisHeight(skeleton) + frame.pelvis.y, frame.pelvis.z);
  q.segment<3>(kRootRx) = Vector3d(frame.pelvis.lean, frame.pelvis.heading, frame.pelvis.tilt);
  q.segment<3>(kUpperbackRx) = Vector3d(frame.spine.bend, frame.spine.twist, frame.spine.side);
  q.segment<3>(kNeckRx) = Vector3d(frame.head.nod, frame.head.side, frame.head.turn);
  for (const Side side : {Side::Left, Side::Right}) {
    writeArm(side, frame.arm(side), q);
    solveLeg(skeleton, frame, side, q);
  }
  const JointLimits& limits = jointLimits();
  for (int i = kFirstBodyDof; i < kDofCount; ++i) {
    q[i] = std::clamp(q[i], limits.lower[i] + kLimitMargin, limits.upper[i] - kLimitMargin);
  }
  return q;
}

double highestPelvis(const Skeleton& skeleton, const BodyFrame& frame) {
  const Sole sole = soleOf(skeleton);
  const double reach = legReach(skeleton, kEasyKneeFlexion);
  double highest = std::numeric_limits<double>::infinity();
  for (const Side side : {Side::Left, Side::Right}) {
    const FootState& foot = frame.foot(side);
    if (foot.lift > kOnGround) continue;
    const Vector3d ankle = anklePosition(sole, foot, std::max(foot.pitch, foot.heel_rise));
    const Vector3d hip = Vector3d(frame.pelvis.x, 0, frame.pelvis.z) + hipOffset(skeleton, frame, side);
    const double level2 = (ankle - hip).head<1>().squaredNorm() + (ankle - hip).tail<1>().squaredNorm();
    const double drop = std::sqrt(std::max(0.01, reach * reach - level2));
    highest = std::min(highest, ankle.y() + drop - hip.y() - standingPelvisHeight(skeleton));
  }
  return highest;
}

Vector3d centerOfMass(const Skeleton& skeleton, const Pose& q) {
  const JointPositions p = jointPositions(skeleton, q);
  struct Segment {
    double mass;
    Joint from, to;
  };
  static constexpr Segment kSegments[] = {{0.435, Joint::Pelvis, Joint::Neck},
                                          {0.069, Joint::Head, Joint::Head},
                                          {0.027, Joint::LeftShoulder, Joint::LeftElbow},
                                          {0.027, Joint::RightShoulder, Joint::RightElbow},
                                          {0.022, Joint::LeftElbow, Joint::LeftWrist},
                                          {0.022, Joint::RightElbow, Joint::RightWrist},
                                          {0.142, Joint::LeftHip, Joint::LeftKnee},
                                          {0.142, Joint::RightHip, Joint::RightKnee},
                                          {0.043, Joint::LeftKnee, Joint::LeftAnkle},
                                          {0.043, Joint::RightKnee, Joint::RightAnkle},
                                          {0.014, Joint::LeftAnkle, Joint::LeftToe},
                                          {0.014, Joint::RightAnkle, Joint::RightToe}};
  Vector3d sum = Vector3d::Zero();
  double mass = 0;
  for (const Segment& s : kSegments) {
    sum += 0.5 * s.mass * (p.col(static_cast<int>(s.from)) + p.col(static_cast<int>(s.to)));
    mass += s.mass;
  }
  return sum / mass;
}

}  // namespace depthmocap

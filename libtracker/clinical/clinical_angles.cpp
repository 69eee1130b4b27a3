#include "libtracker/clinical/clinical_angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "libtracker/clinical/anatomical.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

std::string_view sideName(int side) {
  return side == 0 ? "left" : "right";
}

// The pelvis in the world: rotation, obliquity, tilt (Baker 2001), R = R_up R_forward R_left, so that tilt and
// obliquity do not depend on where the actor faces.
struct PelvisAngles {
  double rotation, obliquity, tilt;
};
PelvisAngles pelvisAngles(const Eigen::Matrix3d& R) {
  return {std::atan2(-R(2, 0), R(0, 0)), std::asin(std::clamp(R(1, 0), -1.0, 1.0)), std::atan2(-R(1, 2), R(1, 1))};
}

// How a limb that hung down is turned about itself, beside being tilted [rad].
double torsion(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d down = -Eigen::Vector3d::UnitY();
  const Eigen::Matrix3d tilt = Eigen::Quaterniond::FromTwoVectors(down, R * down).toRotationMatrix();
  const Eigen::Matrix3d turned = tilt.transpose() * R;
  return std::atan2(turned(0, 2), turned(0, 0));
}

}  // namespace

int clinicalAngleIndex(std::string_view name) {
  const auto found = std::find(kClinicalAngleNames.begin(), kClinicalAngleNames.end(), name);
  return found == kClinicalAngleNames.end() ? -1 : static_cast<int>(found - kClinicalAngleNames.begin());
}

const ClinicalAngles& ClinicalAngleReader::read(const ForwardKinematics& fk) {
  trunk(fk);
  for (const int side : {0, 1}) {
    leg(fk, side);
    arm(fk, side);
  }
  return angles_;
}

void ClinicalAngleReader::trunk(const ForwardKinematics& fk) {
  const PelvisAngles pelvis = pelvisAngles(fk.R_world_bone(Bone::Root));
  set("pelvis_tilt", pelvis.tilt);
  set("pelvis_obliquity", pelvis.obliquity);
  set("pelvis_rotation", pelvis.rotation);
  // Forward is against the turn to the right that flexes a hip.
  const CardanAngles trunk = cardanAngles(relativeRotation(fk, Bone::Root, Bone::UpperBack));
  set("trunk_flexion", -trunk.flexion);
  set("trunk_lateral_flexion", trunk.adduction);
  set("trunk_rotation", trunk.rotation);
  const CardanAngles neck = cardanAngles(relativeRotation(fk, Bone::UpperBack, Bone::Head));
  set("neck_flexion", -neck.flexion);
  set("neck_lateral_flexion", neck.adduction);
  set("neck_rotation", neck.rotation);
}

void ClinicalAngleReader::leg(const ForwardKinematics& fk, int side) {
  const auto of = static_cast<BodySide>(side);
  const double sign = mirrorSign(of);
  const CardanAngles hip = cardanAngles(relativeRotation(fk, Bone::Root, bonesOf(of).femur));
  set(side, "hip_flexion", hip.flexion);
  set(side, "hip_abduction", -sign * hip.adduction);
  set(side, "hip_rotation", sign * hip.rotation);
  set(side, "knee_flexion", kneeFlexion(fk, of));
  const FootAngles foot = footAngles(fk, of);
  set(side, "ankle_dorsiflexion", foot.dorsiflexion);
  set(side, "ankle_rotation", foot.inwards);
}

void ClinicalAngleReader::arm(const ForwardKinematics& fk, int side) {
  const auto of = static_cast<BodySide>(side);
  const double sign = mirrorSign(of);
  // Tilt and torsion (Campeau-Lecours et al. 2020): three turns one after another are singular in the T-pose.
  const Eigen::Matrix3d R = armInThorax(fk, of);
  const Tilt tilt = tiltFromDown(-R.col(1));
  set(side, "shoulder_flexion", tilt.forward);
  set(side, "shoulder_abduction", -sign * tilt.left);
  set(side, "shoulder_rotation", sign * torsion(R));
  set(side, "shoulder_elevation", tilt.angle);
  set(side, "elbow_flexion", elbowFlexion(fk, of));
}

void ClinicalAngleReader::set(std::string_view name, double rad) {
  const int index = clinicalAngleIndex(name);
  DMC_CHECK(index >= 0);
  angles_[index] = kDegrees * unwrapped(rad, angles_[index] / kDegrees);
}

void ClinicalAngleReader::set(int side, std::string_view name, double rad) {
  set(fmt::format("{}_{}", sideName(side), name), rad);
}

ClinicalConfidence clinicalConfidence(const Eigen::Matrix<double, kJointCount, 1>& confidence) {
  const auto least = [&](std::initializer_list<Joint> joints) {
    double c = 1.0;
    for (const Joint joint : joints) c = std::min(c, confidence[static_cast<int>(joint)]);
    return c;
  };
  ClinicalConfidence result;
  result << least({Joint::LeftHip, Joint::RightHip}), least({Joint::Pelvis, Joint::Spine, Joint::Neck}),
      least({Joint::Spine, Joint::Neck, Joint::Head}), least({Joint::Pelvis, Joint::LeftHip, Joint::LeftKnee}),
      least({Joint::LeftHip, Joint::LeftKnee, Joint::LeftAnkle}),
      least({Joint::LeftKnee, Joint::LeftAnkle, Joint::LeftToe}),
      least({Joint::Neck, Joint::LeftShoulder, Joint::LeftElbow}),
      least({Joint::LeftShoulder, Joint::LeftElbow, Joint::LeftWrist}),
      least({Joint::Pelvis, Joint::RightHip, Joint::RightKnee}),
      least({Joint::RightHip, Joint::RightKnee, Joint::RightAnkle}),
      least({Joint::RightKnee, Joint::RightAnkle, Joint::RightToe}),
      least({Joint::Neck, Joint::RightShoulder, Joint::RightElbow}),
      least({Joint::RightShoulder, Joint::RightElbow, Joint::RightWrist});
  return result;
}

int clinicalJointOf(int angle) {
  const std::string_view name = kClinicalAngleNames[static_cast<std::size_t>(angle)];
  for (int joint = 0; joint < kClinicalJointCount; ++joint) {
    if (name.starts_with(kClinicalJointNames[static_cast<std::size_t>(joint)])) return joint;
  }
  DMC_CHECK(false);
  return -1;
}

}  // namespace depthmocap

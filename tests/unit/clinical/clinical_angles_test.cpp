#include "libtracker/clinical/clinical_angles.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;
constexpr double kSame_deg = 1e-6;

ClinicalAngles anglesOf(const Pose& q) {
  ForwardKinematics fk;
  fk.update(makeSkeleton(BoneLengths{}), q);
  return ClinicalAngleReader().read(fk);
}

double angle(const ClinicalAngles& angles, const std::string& name) {
  return angles[clinicalAngleIndex(name)];
}

Eigen::Matrix3d turn(double deg, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(kRad * deg, axis).toRotationMatrix();
}

// A person who stands straight with the arms hanging down.
Pose standing() {
  Pose q = Pose::Zero();
  q[kRhumerusRz] = 90 * kRad;
  q[kLhumerusRz] = -90 * kRad;
  return q;
}

Pose randomPose(Random& random) {
  const JointLimits& limits = jointLimits();
  Pose q = Pose::Zero();
  for (int i = kFirstBodyDof; i < kDofCount; ++i) q[i] = random.uniform(0.6 * limits.lower[i], 0.6 * limits.upper[i]);
  q[kRootRx] = random.uniform(-0.4, 0.4);
  q[kRootRy] = random.uniform(-3.0, 3.0);
  q[kRootRz] = random.uniform(-0.4, 0.4);
  return q;
}

TEST(ClinicalAngles, AreAllZeroInTheAnatomicalPosition) {
  EXPECT_LT(anglesOf(standing()).cwiseAbs().maxCoeff(), kSame_deg);
}

TEST(ClinicalAngles, TheTPoseIsArmsAbductedByARightAngle) {
  const ClinicalAngles angles = anglesOf(Pose::Zero());
  for (const std::string side : {"left", "right"}) {
    EXPECT_NEAR(angle(angles, side + "_shoulder_abduction"), 90, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_shoulder_elevation"), 90, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_shoulder_flexion"), 0, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_shoulder_rotation"), 0, kSame_deg);
  }
}

TEST(ClinicalAngles, KneesBentByARightAngle) {
  Pose q = standing();
  q[kRtibiaRx] = q[kLtibiaRx] = 90 * kRad;
  const ClinicalAngles angles = anglesOf(q);
  EXPECT_NEAR(angle(angles, "left_knee_flexion"), 90, kSame_deg);
  EXPECT_NEAR(angle(angles, "right_knee_flexion"), 90, kSame_deg);
  EXPECT_NEAR(angle(angles, "right_hip_flexion"), 0, kSame_deg);
}

TEST(ClinicalAngles, ArmsAbductedBySixtyDegrees) {
  Pose q = Pose::Zero();
  q[kRhumerusRz] = 30 * kRad;
  q[kLhumerusRz] = -30 * kRad;
  const ClinicalAngles angles = anglesOf(q);
  for (const std::string side : {"left", "right"}) {
    EXPECT_NEAR(angle(angles, side + "_shoulder_abduction"), 60, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_shoulder_flexion"), 0, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_shoulder_rotation"), 0, kSame_deg);
  }
}

TEST(ClinicalAngles, ArmsStretchedForwardWithElbowsBent) {
  Pose q = standing();
  const Eigen::Matrix3d forward = turn(-90, Eigen::Vector3d::UnitX());  // hanging arms to the front
  setLocalRotation(Bone::RightHumerus, forward * turn(90, Eigen::Vector3d::UnitZ()), q);
  setLocalRotation(Bone::LeftHumerus, forward * turn(-90, Eigen::Vector3d::UnitZ()), q);
  q[kRradiusRy] = 45 * kRad;
  q[kLradiusRy] = -45 * kRad;
  const ClinicalAngles angles = anglesOf(q);
  for (const std::string side : {"left", "right"}) {
    EXPECT_NEAR(angle(angles, side + "_shoulder_flexion"), 90, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_shoulder_abduction"), 0, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_shoulder_rotation"), 0, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_elbow_flexion"), 45, kSame_deg);
  }
}

TEST(ClinicalAngles, HipsTurnFlexionThenAbductionThenRotation) {
  Pose q = standing();
  const auto x = Eigen::Vector3d::UnitX();
  const auto y = Eigen::Vector3d::UnitY();
  const auto z = Eigen::Vector3d::UnitZ();
  // The right leg forward and up, out to the right, toes in; the left one mirrored.
  setLocalRotation(Bone::RightFemur, turn(-40, x) * turn(-20, z) * turn(10, y), q);
  setLocalRotation(Bone::LeftFemur, turn(-40, x) * turn(20, z) * turn(-10, y), q);
  const ClinicalAngles angles = anglesOf(q);
  for (const std::string side : {"left", "right"}) {
    EXPECT_NEAR(angle(angles, side + "_hip_flexion"), 40, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_hip_abduction"), 20, kSame_deg);
    EXPECT_NEAR(angle(angles, side + "_hip_rotation"), 10, kSame_deg);
  }
}

TEST(ClinicalAngles, ToesUpIsDorsiflexion) {
  Pose q = standing();
  q[kRfootRx] = q[kLfootRx] = -15 * kRad;
  EXPECT_NEAR(angle(anglesOf(q), "left_ankle_dorsiflexion"), 15, kSame_deg);
  EXPECT_NEAR(angle(anglesOf(q), "right_ankle_dorsiflexion"), 15, kSame_deg);
}

TEST(ClinicalAngles, ABowIsTrunkFlexionAndTheHeadingIsPelvisRotation) {
  Pose q = standing();
  q[kUpperbackRx] = 25 * kRad;
  q[kRootRy] = 130 * kRad;
  q[kRootRx] = 12 * kRad;
  q[kHeadRy] = 35 * kRad;
  const ClinicalAngles angles = anglesOf(q);
  EXPECT_NEAR(angle(angles, "trunk_flexion"), 25, kSame_deg);
  EXPECT_NEAR(angle(angles, "pelvis_rotation"), 130, kSame_deg);
  EXPECT_NEAR(angle(angles, "pelvis_tilt"), 12, kSame_deg);
  EXPECT_NEAR(angle(angles, "pelvis_obliquity"), 0, kSame_deg);
  EXPECT_NEAR(angle(angles, "neck_rotation"), 35, kSame_deg);
}

TEST(ClinicalAngles, HingesAgreeWithTheJointsPlaces) {
  Random random(3);
  const auto bend = [](const JointPositions& p, Joint a, Joint b, Joint c) {
    const Eigen::Vector3d before = p.col(static_cast<int>(b)) - p.col(static_cast<int>(a));
    const Eigen::Vector3d after = p.col(static_cast<int>(c)) - p.col(static_cast<int>(b));
    return std::atan2(before.cross(after).norm(), before.dot(after)) / kRad;
  };
  for (int i = 0; i < 100; ++i) {
    const Pose q = randomPose(random);
    const JointPositions p = jointPositions(makeSkeleton(BoneLengths{}), q);
    const ClinicalAngles angles = anglesOf(q);
    EXPECT_NEAR(std::abs(angle(angles, "left_knee_flexion")),
                bend(p, Joint::LeftHip, Joint::LeftKnee, Joint::LeftAnkle), 1e-4);
    EXPECT_NEAR(std::abs(angle(angles, "right_elbow_flexion")),
                bend(p, Joint::RightShoulder, Joint::RightElbow, Joint::RightWrist), 1e-4);
  }
}

TEST(ClinicalAngles, TheMirrorImageExchangesSides) {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Pose q = randomPose(random);
    const ClinicalAngles a = anglesOf(q);
    const ClinicalAngles b = anglesOf(mirroredPose(q));
    for (int k = 0; k < kClinicalAngleCount; ++k) {
      const std::string name(kClinicalAngleNames[static_cast<std::size_t>(k)]);
      double expected = a[k];
      if (name.starts_with("left_")) expected = angle(a, "right_" + name.substr(5));
      if (name.starts_with("right_")) expected = angle(a, "left_" + name.substr(6));
      const bool to_a_side = name == "pelvis_obliquity" || name == "pelvis_rotation" ||
                             name == "trunk_lateral_flexion" || name == "trunk_rotation" ||
                             name == "neck_lateral_flexion" || name == "neck_rotation";
      EXPECT_NEAR(b[k], to_a_side ? -expected : expected, 1e-5) << name;
    }
  }
}

TEST(ClinicalAngles, GoOnThroughFullTurns) {
  ClinicalAngleReader reader;
  ForwardKinematics fk;
  Pose q = standing();
  for (int deg = 0; deg <= 720; deg += 10) {
    q[kRootRy] = deg * kRad;
    fk.update(makeSkeleton(BoneLengths{}), q);
    EXPECT_NEAR(angle(reader.read(fk), "pelvis_rotation"), deg, kSame_deg);
  }
}

TEST(ClinicalAngles, EachIsAboutAJoint) {
  EXPECT_EQ(kClinicalJointNames[static_cast<std::size_t>(clinicalJointOf(clinicalAngleIndex("right_knee_flexion")))],
            "right_knee");
  Eigen::Matrix<double, kJointCount, 1> confidence = Eigen::Matrix<double, kJointCount, 1>::Ones();
  confidence[static_cast<int>(Joint::RightAnkle)] = 0.25;
  const ClinicalConfidence c = clinicalConfidence(confidence);
  EXPECT_EQ(c[clinicalJointOf(clinicalAngleIndex("right_knee_flexion"))], 0.25);
  EXPECT_EQ(c[clinicalJointOf(clinicalAngleIndex("right_hip_flexion"))], 1.0);
  EXPECT_EQ(c[clinicalJointOf(clinicalAngleIndex("left_knee_flexion"))], 1.0);
}

}  // namespace
}  // namespace depthmocap

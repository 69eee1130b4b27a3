#include "libtracker/skeleton/forward_kinematics.h"

#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/skeleton/skeleton.h"
#include "tests/gradient_check.h"

namespace depthmocap {
namespace {

constexpr double kPi = std::numbers::pi;

// Rotations uniform in [-range, range], translations in [-1, 1].
Pose randomPose(Random& random, double range) {
  Pose q;
  for (int i = 0; i < kDofCount; ++i) q[i] = (i < kFirstRotationDof ? 1.0 : range) * random.uniform(-1.0, 1.0);
  return q;
}

Bone boneAt(int i) {
  return static_cast<Bone>(i);
}

TEST(ForwardKinematics, JacobianMatchesDifferencesForEveryJoint) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  Random random(1);
  for (const double range : {0.0, 1e-6, 2e-4, 2e-3, 0.4, 1.3, 2.2}) {
    const Pose q = randomPose(random, range);
    for (const BonePoint& joint : jointPoints(skeleton)) {
      const auto position = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        ForwardKinematics fk;
        fk.update(skeleton, x);
        return fk.position(joint);
      };
      const auto jacobian = [&](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
        ForwardKinematics fk;
        fk.update(skeleton, x);
        PointJacobian J;
        fk.jacobian(joint, J);
        return J;
      };
      expectJacobianMatches(q, position, jacobian, 1e-7);
    }
  }
}

TEST(ForwardKinematics, ZeroPoseIsATPose) {
  const BoneLengths lengths;
  const JointPositions p = jointPositions(makeSkeleton(lengths), Pose::Zero());
  const auto at = [&](Joint joint) -> Eigen::Vector3d { return p.col(static_cast<int>(joint)); };
  EXPECT_NEAR((at(Joint::LeftWrist) - at(Joint::RightWrist)).x(),
              lengths.shoulder_width + 2 * (lengths.upper_arm + lengths.lower_arm), 1e-12);
  EXPECT_GT(at(Joint::LeftWrist).x(), 0);
  EXPECT_NEAR(at(Joint::LeftWrist).y(), at(Joint::LeftShoulder).y(), 1e-12);
  EXPECT_NEAR(at(Joint::LeftHip).y() - at(Joint::LeftAnkle).y(), lengths.upper_leg + lengths.lower_leg, 1e-12);
  EXPECT_GT(at(Joint::LeftToe).z(), at(Joint::LeftAnkle).z());
  EXPECT_NEAR(at(Joint::Head).y() - at(Joint::Pelvis).y(), lengths.torso + lengths.neck_to_head, 1e-12);
}

TEST(ForwardKinematics, FlexionSignsAreAsDocumented) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  Pose q = Pose::Zero();
  q[kRradiusRy] = 0.5;
  q[kLradiusRy] = -0.5;
  q[kRtibiaRx] = 0.5;
  q[kRfootRx] = 0.3;
  const JointPositions zero = jointPositions(skeleton, Pose::Zero());
  const JointPositions p = jointPositions(skeleton, q);
  const auto moved = [&](Joint joint) -> Eigen::Vector3d {
    return p.col(static_cast<int>(joint)) - zero.col(static_cast<int>(joint));
  };
  EXPECT_GT(moved(Joint::RightWrist).z(), 0.05);
  EXPECT_GT(moved(Joint::LeftWrist).z(), 0.05);
  EXPECT_LT(moved(Joint::RightAnkle).z(), -0.05);
  q.setZero();
  q[kRfootRx] = 0.3;
  EXPECT_LT(jointPositions(skeleton, q).col(static_cast<int>(Joint::RightToe)).y(),
            zero.col(static_cast<int>(Joint::RightToe)).y());
}

TEST(ForwardKinematics, HeadingTurnsTheWholeBodyAboutTheVertical) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  Random random(2);
  Pose q = randomPose(random, 0.8);
  q.head<3>().setZero();
  q[kRootRy] = 0.2;
  const JointPositions before = jointPositions(skeleton, q);
  q[kRootRy] += 0.7;
  const Eigen::Matrix3d R = Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY()).toRotationMatrix();
  EXPECT_LT((jointPositions(skeleton, q) - R * before).norm(), 1e-12);
}

TEST(ForwardKinematics, LocalRotationRoundTrips) {
  Random random(3);
  for (const double range : {0.0, 1e-9, 1e-5, 0.1, 1.0, 2.0}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const Pose q = randomPose(random, range);
      Pose back = q;
      back.tail<kDofCount - 3>().setZero();
      for (int b = 0; b < kBoneCount; ++b) {
        EXPECT_LT(setLocalRotation(boneAt(b), localRotation(boneAt(b), q), back), 1e-6) << kBoneNames[b];
      }
      EXPECT_LT((back - q).cwiseAbs().maxCoeff(), 1e-8) << "range " << range;
    }
  }
}

TEST(ForwardKinematics, ThreeDofBonesExpressEveryRotation) {
  Random random(4);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Eigen::Vector3d axis = Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Eigen::Matrix3d R = Eigen::AngleAxisd(random.uniform(-0.95 * kPi, 0.95 * kPi), axis).toRotationMatrix();
    for (int b = 0; b < kBoneCount; ++b) {
      Pose q = Pose::Zero();
      const double residual = setLocalRotation(boneAt(b), R, q);
      const double angle = Eigen::AngleAxisd(localRotation(boneAt(b), q).transpose() * R).angle();
      EXPECT_NEAR(angle, residual, 1e-6) << kBoneNames[b];
      if (kBoneDofs[static_cast<std::size_t>(b)].count == 3) {
        EXPECT_LT(residual, 1e-6) << kBoneNames[b];
      }
    }
  }
}

int mirroredJoint(int joint) {
  std::string name(kJointNames[static_cast<std::size_t>(joint)]);
  if (name.starts_with("left_")) {
    name = "right_" + name.substr(5);
  } else if (name.starts_with("right_")) {
    name = "left_" + name.substr(6);
  }
  for (int j = 0; j < kJointCount; ++j) {
    if (kJointNames[static_cast<std::size_t>(j)] == name) return j;
  }
  return -1;
}

TEST(MirroredPose, IsTheMirrorImageInSpace) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  Random random(5);
  for (int repeat = 0; repeat < 10; ++repeat) {
    const Pose q = randomPose(random, 1.2);
    const JointPositions p = jointPositions(skeleton, q);
    const JointPositions m = jointPositions(skeleton, mirroredPose(q));
    for (int j = 0; j < kJointCount; ++j) {
      const Eigen::Vector3d expected = Eigen::Vector3d(-1, 1, 1).asDiagonal() * p.col(mirroredJoint(j));
      EXPECT_LT((m.col(j) - expected).norm(), 1e-12) << kJointNames[static_cast<std::size_t>(j)];
    }
    EXPECT_EQ(mirroredPose(mirroredPose(q)), q);
  }
}

}  // namespace
}  // namespace depthmocap

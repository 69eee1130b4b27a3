#include "libtracker/output/vr_trackers.h"

#include <Eigen/Geometry>
#include <numbers>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/output/tracker_sender.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/support/osc_receiver.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

constexpr double kRad = std::numbers::pi / 180.0;

// Unity's Quaternion.Euler: about z, then x, then y.
Eigen::Matrix3d unityRotation(const Eigen::Vector3d& euler_deg) {
  return (Eigen::AngleAxisd(kRad * euler_deg.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(kRad * euler_deg.x(), Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(kRad * euler_deg.z(), Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

const Eigen::DiagonalMatrix<double, 3> kMirror(-1.0, 1.0, 1.0);

TEST(VrTrackers, AreOurBonesInTheMirrorOfUnitysAxes) {
  Random random(14);
  const Skeleton skeleton = makeSkeleton(averageBoneLengths(1.75));
  constexpr std::array<Bone, kVrTrackerCount> kAt = {Bone::Root,       Bone::LeftFoot,    Bone::RightFoot,
                                                     Bone::LeftTibia,  Bone::RightTibia,  Bone::UpperBack,
                                                     Bone::LeftRadius, Bone::RightRadius, Bone::Head};
  constexpr std::array<Bone, kVrTrackerCount> kTurned = {Bone::Root,        Bone::LeftFoot,     Bone::RightFoot,
                                                         Bone::LeftFemur,   Bone::RightFemur,   Bone::UpperBack,
                                                         Bone::LeftHumerus, Bone::RightHumerus, Bone::Head};
  for (int i = 0; i < 50; ++i) {
    Pose q;
    for (int d = 0; d < kDofCount; ++d) q[d] = random.uniform(-1.2, 1.2);
    const Eigen::Vector3d origin(0.3, -1.0, 0.2);
    ForwardKinematics fk;
    fk.update(skeleton, q);
    const auto trackers = vrTrackers(skeleton, q, origin);
    for (std::size_t t = 0; t < trackers.size(); ++t) {
      const Eigen::Matrix3d expected = kMirror * fk.R_world_bone(kTurned[t]) * kMirror;
      EXPECT_LT((unityRotation(trackers[t].euler_deg) - expected).norm(), 1e-9) << t;
      if (kAt[t] == Bone::UpperBack || kAt[t] == Bone::Head) continue;  // worn away from the joint
      EXPECT_LT((trackers[t].position - kMirror * (fk.origin(kAt[t]) - origin)).norm(), 1e-9) << t;
    }
  }
}

// The T-pose facing forward: the left elbow is to the left, Unity's x points right.
TEST(VrTrackers, TheTPoseStandsUprightAndUnturned) {
  const BoneLengths lengths = averageBoneLengths(1.75);
  Pose q = Pose::Zero();
  q[kRootTy] = 0.95;
  const auto trackers = vrTrackers(makeSkeleton(lengths), q, Eigen::Vector3d::Zero());
  for (const VrTracker& tracker : trackers) EXPECT_LT(tracker.euler_deg.norm(), 1e-9);
  EXPECT_LT(trackers[6].position.x(), -0.3);
  EXPECT_GT(trackers[7].position.x(), 0.3);
  EXPECT_GT(trackers[8].position.y(), trackers[5].position.y());
  EXPECT_GT(trackers[5].position.y(), trackers[0].position.y());
}

TEST(TrackerSender, SendsPositionAndRotationOfEachTrackerWithFeetOnTheFloor) {
  OscReceiver receiver;
  TrackerSender sender(receiver.target());
  const BoneLengths lengths = averageBoneLengths(1.75);
  Pose q = Pose::Zero();
  q.head<3>() = Eigen::Vector3d(0.4, -0.3, -2.5);
  q[kRootRy] = 30 * kRad;
  sender.send(1.0, TrackState::Tracking, lengths, q);
  const auto messages = receiver.receive();
  std::set<std::string> addresses;
  for (const OscMessage& message : messages) {
    addresses.insert(message.address);
    EXPECT_EQ(message.types, ",fff");
    if (message.address == "/tracking/trackers/1/position") {
      EXPECT_NEAR(message.floats[0], 0, 1e-6);
      EXPECT_NEAR(message.floats[2], 0, 1e-6);
    }
    if (message.address == "/tracking/trackers/2/position") {
      EXPECT_NEAR(message.floats[1], ankleHeight(lengths), 1e-5);
    }
    if (message.address == "/tracking/trackers/head/rotation") {
      EXPECT_NEAR(message.floats[1], -30, 1e-4);  // our left turn is Unity's
    }
  }
  EXPECT_EQ(messages.size(), 18U);
  EXPECT_EQ(addresses.size(), 18U);
  EXPECT_TRUE(addresses.contains("/tracking/trackers/8/rotation"));
  EXPECT_TRUE(addresses.contains("/tracking/trackers/head/position"));
}

TEST(TrackerSender, SaysNothingOfALostActor) {
  OscReceiver receiver;
  TrackerSender sender(receiver.target());
  sender.send(1.0, TrackState::Lost, averageBoneLengths(1.75), Pose::Zero());
  sender.send(2.0, TrackState::Coasting, averageBoneLengths(1.75), Pose::Zero());
  EXPECT_EQ(receiver.receive().size(), 18U);
}

TEST(TrackerSender, RefusesWhatIsNoTarget) {
  EXPECT_NE(errorOf([] { TrackerSender("localhost"); }).find("--osc-trackers localhost: no host and port"),
            std::string::npos);
  EXPECT_NE(errorOf([] { TrackerSender("localhost:0"); }), "");
}

}  // namespace
}  // namespace depthmocap

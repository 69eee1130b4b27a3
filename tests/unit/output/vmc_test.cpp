#include <array>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/output/floor_origin.h"
#include "libtracker/output/vmc_bones.h"
#include "libtracker/output/vmc_listener.h"
#include "libtracker/output/vmc_sender.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"
#include "tests/support/osc_receiver.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

// Unity's hierarchy of the humanoid bones that are sent.
const std::map<std::string, std::string>& parents() {
  static const std::map<std::string, std::string> map = {{"Spine", "Hips"},
                                                         {"Neck", "Spine"},
                                                         {"Head", "Neck"},
                                                         {"LeftShoulder", "Spine"},
                                                         {"LeftUpperArm", "LeftShoulder"},
                                                         {"LeftLowerArm", "LeftUpperArm"},
                                                         {"LeftHand", "LeftLowerArm"},
                                                         {"RightShoulder", "Spine"},
                                                         {"RightUpperArm", "RightShoulder"},
                                                         {"RightLowerArm", "RightUpperArm"},
                                                         {"RightHand", "RightLowerArm"},
                                                         {"LeftUpperLeg", "Hips"},
                                                         {"LeftLowerLeg", "LeftUpperLeg"},
                                                         {"LeftFoot", "LeftLowerLeg"},
                                                         {"LeftToes", "LeftFoot"},
                                                         {"RightUpperLeg", "Hips"},
                                                         {"RightLowerLeg", "RightUpperLeg"},
                                                         {"RightFoot", "RightLowerLeg"},
                                                         {"RightToes", "RightFoot"}};
  return map;
}

using Bones = std::map<std::string, Eigen::Isometry3d>;  // in Unity's coordinates

Bones localBones(const std::vector<OscMessage>& messages) {
  Bones bones;
  for (const OscMessage& m : messages) {
    if (m.address != "/VMC/Ext/Bone/Pos") continue;
    EXPECT_EQ(m.types, ",sfffffff");
    const auto& f = m.floats;
    const Eigen::Quaternionf r(f.at(6), f.at(3), f.at(4), f.at(5));
    bones[m.text] = Eigen::Translation3d(f.at(0), f.at(1), f.at(2)) * r.cast<double>();
  }
  return bones;
}

Eigen::Isometry3d globalBone(const Bones& bones, const std::string& name) {
  const auto parent = parents().find(name);
  if (parent == parents().end()) return bones.at(name);
  return globalBone(bones, parent->second) * bones.at(name);
}

TEST(VmcSender, ReceiverRebuildsTheSkeleton) {
  const std::array<const char*, kJointCount> names = {"Hips",          "Spine",        "Neck",          "",
                                                      "LeftUpperArm",  "LeftLowerArm", "LeftHand",      "RightUpperArm",
                                                      "RightLowerArm", "RightHand",    "LeftUpperLeg",  "LeftLowerLeg",
                                                      "LeftFoot",      "LeftToes",     "RightUpperLeg", "RightLowerLeg",
                                                      "RightFoot",     "RightToes"};
  const Eigen::Vector3d mirror(-1, 1, 1);  // Unity's x is ours mirrored
  OscReceiver receiver;
  VmcSender sender(receiver.target());
  const BoneLengths lengths = averageBoneLengths(1.71);
  const Skeleton skeleton = makeSkeleton(lengths);
  Random random(4);
  for (int frame = 0; frame < 20; ++frame) {
    Pose q;
    for (int i = 0; i < kDofCount; ++i) q[i] = random.uniform(-1.5, 1.5);
    q = clampedToLimits(q);
    sender.send(frame / 30.0, TrackState::Tracking, lengths, q);
    auto messages = receiver.receive();
    EXPECT_EQ(messages.at(0).address, "/VMC/Ext/OK");
    EXPECT_EQ(messages.at(0).ints, (std::vector<int>{1, 3, 0, 1}));
    EXPECT_EQ(messages.at(1).address, "/VMC/Ext/T");
    EXPECT_NEAR(messages.at(1).floats.at(0), frame / 30.0, 1e-5);
    EXPECT_EQ(messages.at(2).address, "/VMC/Ext/Root/Pos");
    for (const OscMessage& m : receiver.receive()) messages.push_back(m);
    const Bones bones = localBones(messages);
    ASSERT_EQ(bones.size(), static_cast<std::size_t>(kVmcBoneCount));
    const JointPositions expected = jointPositions(skeleton, q);
    const Eigen::Vector3d hips = globalBone(bones, "Hips").translation();
    for (int j = 0; j < kJointCount; ++j) {
      if (j == static_cast<int>(Joint::Head)) continue;  // Unity's head starts at the top of the neck
      const Eigen::Vector3d p = globalBone(bones, names[static_cast<std::size_t>(j)]).translation() - hips;
      const Eigen::Vector3d e = mirror.cwiseProduct(expected.col(j) - expected.col(0));
      EXPECT_LT((p - e).norm(), 1e-4) << names[static_cast<std::size_t>(j)];
    }
    ForwardKinematics fk;
    fk.update(skeleton, q);
    const Eigen::Matrix3d M = mirror.asDiagonal();
    const Eigen::Matrix3d arm = M * fk.R_world_bone(Bone::RightRadius) * M;
    EXPECT_LT(Eigen::AngleAxisd(Eigen::Matrix3d(arm.transpose() * globalBone(bones, "RightLowerArm").linear())).angle(),
              1e-3);
  }
}

TEST(VmcSender, RestPoseIsUnitysTPose) {
  const auto bones = vmcBones(makeSkeleton(BoneLengths{}), Pose::Zero(), Eigen::Vector3d::Zero());
  for (const VmcBone& bone : bones) EXPECT_LT(bone.rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-12);
  const auto bone = [&](std::string_view name) {
    const auto found = std::find(kVmcBoneNames.begin(), kVmcBoneNames.end(), name);
    return bones.at(static_cast<std::size_t>(found - kVmcBoneNames.begin()));
  };
  EXPECT_LT(bone("LeftLowerArm").position.x(), -0.2);  // left is -x when looking along +z
  EXPECT_GT(bone("LeftToes").position.z(), 0.1);
}

TEST(VmcSender, LostFrameSaysSoAndSendsNoBones) {
  OscReceiver receiver;
  VmcSender sender(receiver.target());
  sender.send(0, TrackState::Lost, BoneLengths{}, Pose::Zero());
  const auto messages = receiver.receive();
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_EQ(messages[0].ints.back(), 0);
}

TEST(VmcSender, BadTargetsAreNamed) {
  for (const char* target : {"", "localhost", ":39539", "localhost:x", "localhost:0", "localhost:70000"}) {
    EXPECT_NE(errorOf([&] { VmcSender sender(target); }).find("HOST:PORT"), std::string::npos) << target;
  }
  EXPECT_EQ(errorOf([&] { VmcSender sender("[::1]:39539"); }), "");
}

// An OSC text of zeros to the next multiple of four.
std::string oscText(std::string text) {
  text.resize((text.size() / 4 + 1) * 4, '\0');
  return text;
}

TEST(VmcListener, HearsThatACalibrationIsAskedFor) {
  VmcListener listener(0);
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(listener.port()));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const auto send = [&](const std::string& packet) {
    ::sendto(socket, packet.data(), packet.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to);
  };
  const auto heard = [&] {
    for (int i = 0; i < 50; ++i) {
      if (listener.calibrationAsked()) return true;
      usleep(2000);
    }
    return false;
  };
  EXPECT_FALSE(listener.calibrationAsked());
  send(oscText("/VMC/Ext/Set/Calib/Exec") + oscText(",i") + std::string(4, '\0'));
  EXPECT_TRUE(heard());
  send(oscText("/VMC/Ext/Set/Calib/Ready") + oscText(","));
  EXPECT_TRUE(heard());
  Random random(6);
  for (int i = 0; i < 50; ++i) {
    std::string garbage = i % 2 == 0 ? oscText("/VMC/Ext/Set/Period") : "";
    for (int k = 0; k < 60; ++k) garbage += static_cast<char>(random.below(256));
    send(garbage);
  }
  EXPECT_FALSE(heard());
  EXPECT_NE(errorOf([&] { VmcListener other(listener.port()); }).find("--vmc-listen"), std::string::npos);
  ::close(socket);
}

TEST(FloorOrigin, IsBelowTheFirstPlaceAtTheHeightOfTheSoles) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  FloorOrigin floor;
  Pose q = Pose::Zero();
  q.head<3>() << 0.4, -0.1, -2.5;
  const double leg = skeleton.lengths.hip_drop + skeleton.lengths.upper_leg + skeleton.lengths.lower_leg;
  const double height = leg + ankleHeight(skeleton.lengths);
  EXPECT_LT((floor.update(skeleton, q, 0.0) - Eigen::Vector3d(0.4, -0.1 - height, -2.5)).norm(), 1e-12);
  q[kRootTy] = 0.2;  // a jump of a third of a second
  for (int i = 1; i <= 10; ++i) floor.update(skeleton, q, i / 30.0);
  q[kRootTx] = 2.0;
  const Eigen::Vector3d after = floor.update(skeleton, q, 11 / 30.0);
  EXPECT_NEAR(after.y(), -0.1 - height, 0.03);
  EXPECT_EQ(after.x(), 0.4);
}

}  // namespace
}  // namespace depthmocap

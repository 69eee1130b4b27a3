#include "libtracker/motion/rig.h"

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "libtracker/motion/bone_names.h"
#include "libtracker/motion/bvh_writer.h"
#include "libtracker/motion/motion_files.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

Pose randomPose(Random& random) {
  Pose q;
  for (int i = 0; i < kDofCount; ++i) q[i] = random.uniform(-0.9, 0.9);
  return q;
}

MotionFrame frameOf(const Rig& rig, const Pose& q) {
  MotionFrame frame;
  for (const MotionBone& bone : rig.bones()) frame.position.push_back(bone.offset);
  std::ranges::copy(rig.positions(q), frame.position.begin());
  frame.rotation = rig.rotations(q);
  return frame;
}

class RigTest : public testing::TestWithParam<RigStyle> {};

TEST_P(RigTest, BonesStartWhereOursDo) {
  Random random(21);
  const Skeleton skeleton = makeSkeleton(averageBoneLengths(1.8));
  const Rig rig(GetParam(), skeleton);
  for (int i = 0; i < 20; ++i) {
    const Pose q = randomPose(random);
    GlobalFrame global;
    globalFrame(rig.bones(), frameOf(rig, q), global);
    ForwardKinematics fk;
    fk.update(skeleton, q);
    for (int b = 0; b < kBoneCount; ++b) {
      const auto bone = static_cast<Bone>(b);
      const Eigen::Vector3d p = global.position[static_cast<std::size_t>(rig.indexOf(bone))];
      EXPECT_LT((p - fk.origin(bone)).norm(), 1e-9) << kBoneNames[static_cast<std::size_t>(b)];
    }
    const Eigen::Vector3d wrist = fk.position({Bone::LeftRadius, skeleton.left_wrist});
    EXPECT_LT((global.position[rig.bones().size() - 3] - wrist).norm(), 1e-9);
  }
}

TEST_P(RigTest, TheRestPoseTurnsNoBone) {
  const Rig rig(GetParam(), makeSkeleton(BoneLengths{}));
  for (const Eigen::Quaterniond& r : rig.rotations(rig.rest())) {
    EXPECT_LT(r.angularDistance(Eigen::Quaterniond::Identity()), 1e-7);
  }
}

TEST_P(RigTest, OurReaderKnowsItsNames) {
  const Rig rig(GetParam(), makeSkeleton(BoneLengths{}));
  const NamedBones named = namedBones(rig.bones(), {}, "rig");
  EXPECT_EQ(named.head, rig.indexOf(Bone::Head));
  EXPECT_EQ(named.left.humerus, rig.indexOf(Bone::LeftHumerus));
  EXPECT_EQ(named.right.radius, rig.indexOf(Bone::RightRadius));
  EXPECT_EQ(named.left.femur, rig.indexOf(Bone::LeftFemur));
  EXPECT_EQ(named.right.tibia, rig.indexOf(Bone::RightTibia));
  EXPECT_EQ(named.left.foot, rig.indexOf(Bone::LeftFoot));
}

TEST_P(RigTest, BvhFilesSayWhereTheJointsAre) {
  const TemporaryFolder folder;
  Random random(4);
  const Skeleton skeleton = makeSkeleton(averageBoneLengths(1.7));
  const Pose q = randomPose(random);
  BvhWriter writer(folder / "a.bvh", skeleton, 30.0, 1.0, false, GetParam());
  writer.write(q);
  writer.finish();
  const SourceMotion motion = readBvh(folder / "a.bvh");
  GlobalFrame global;
  globalFrame(motion.bones, motion.frames.at(0), global);
  ForwardKinematics fk;
  fk.update(skeleton, q);
  const Rig rig(GetParam(), skeleton);
  for (const Bone bone : {Bone::Root, Bone::LeftRadius, Bone::RightFoot, Bone::Head}) {
    const int index = motion.find(rig.bones()[static_cast<std::size_t>(rig.indexOf(bone))].name);
    ASSERT_GE(index, 0);
    EXPECT_LT((global.position[static_cast<std::size_t>(index)] - fk.origin(bone)).norm(), 1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Styles, RigTest,
                         testing::Values(RigStyle::MotionBuilder, RigStyle::Mixamo, RigStyle::Rigify, RigStyle::Unreal,
                                         RigStyle::Vrm),
                         [](const auto& style) {
                           return std::string(kRigNames[static_cast<std::size_t>(style.param)]);
                         });

TEST(Rig, UnrealsRootStandsOnTheFloorBelowTheHips) {
  const Rig rig(RigStyle::Unreal, makeSkeleton(BoneLengths{}));
  EXPECT_EQ(rig.movingBones(), 2);
  EXPECT_EQ(rig.bones()[0].name, "root");
  Pose q = Pose::Zero();
  q.head<3>() = Eigen::Vector3d(1, 0.9, -2);
  EXPECT_EQ(rig.positions(q)[0], Eigen::Vector3d(1, 0, -2));
  EXPECT_EQ(rig.positions(q)[1], Eigen::Vector3d(0, 0.9, 0));
}

TEST(Rig, UnknownNamesAreRefused) {
  EXPECT_EQ(rigStyle("unreal"), RigStyle::Unreal);
  EXPECT_NE(errorOf([] { rigStyle("maya"); }).find("known: motionbuilder"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap

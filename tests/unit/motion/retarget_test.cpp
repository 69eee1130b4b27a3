#include "libtracker/motion/retarget.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "libtracker/motion/asf_amc.h"
#include "libtracker/motion/bvh_writer.h"
#include "libtracker/motion/motion_files.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/unit/motion/motion_test_files.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using test::errorOf;

// Walks from random pose to random pose, so that the fit of one frame can start from the frame before.
std::vector<Pose> smoothPoses(int keys, int between, double share) {
  Random random(11);
  std::vector<Pose> poses;
  Pose from = Pose::Zero();
  for (int k = 0; k < keys; ++k) {
    const Pose to = test::randomPose(random, share);
    for (int i = 0; i < between; ++i) poses.push_back(from + (to - from) * (static_cast<double>(i) / between));
    from = to;
  }
  return poses;
}

BoneLengths performer() {
  BoneLengths lengths = averageBoneLengths(1.83);
  lengths.upper_arm *= 1.1;
  lengths.hip_width *= 0.9;
  lengths.foot *= 0.8;
  lengths.hip_drop = BoneLengths{}.hip_drop * (lengths.upper_leg + lengths.lower_leg) /
                     (BoneLengths{}.upper_leg + BoneLengths{}.lower_leg);
  return lengths;
}

// A motion file's motion on our skeleton, with our names, in metres.
SourceMotion sourceOf(const std::vector<Pose>& poses, const Skeleton& skeleton, double fps = 30.0) {
  SourceMotion motion{Rig(RigStyle::MotionBuilder, skeleton).bones(), fps, {}};
  for (const Pose& q : poses) {
    MotionFrame frame;
    for (std::size_t b = 0; b < motion.bones.size(); ++b) {
      frame.position.push_back(b == 0 ? Vector3d(q.head<3>()) : motion.bones[b].offset);
      frame.rotation.push_back(b < kBoneCount ? Eigen::Quaterniond(localRotation(static_cast<Bone>(b), q))
                                              : Eigen::Quaterniond::Identity());
    }
    motion.frames.push_back(frame);
  }
  return motion;
}

double worstAngle(const std::vector<Pose>& a, const std::vector<Pose>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, (a[i] - b[i]).tail<kDofCount - kFirstRotationDof>().cwiseAbs().maxCoeff());
  }
  return worst;
}

RetargetResult retargeted(const SourceMotion& motion, double metres_per_unit, const std::string& where = "test") {
  return retarget(motion, namedBones(motion.bones, {}, where), metres_per_unit, where);
}

void rename(SourceMotion& motion, const std::map<std::string, std::string>& names) {
  for (MotionBone& bone : motion.bones) {
    const auto found = names.find(bone.name);
    if (found != names.end()) bone.name = found->second;
  }
}

TEST(Retarget, RecoversOurOwnPosesAndLengths) {
  const Skeleton skeleton = makeSkeleton(performer());
  const std::vector<Pose> poses = smoothPoses(12, 15, 0.6);
  const RetargetResult result = retargeted(sourceOf(poses, skeleton), 1.0);
  for (const auto field : kBoneLengthFields) EXPECT_NEAR(result.clip.lengths.*field, skeleton.lengths.*field, 1e-6);
  ASSERT_EQ(result.clip.poses.size(), poses.size());
  EXPECT_LT(worstAngle(result.clip.poses, poses), 0.02);
  for (const double residual : result.residuals.max_m) EXPECT_LT(residual, 0.003);
}

TEST(Retarget, RestPoseIsTheZeroPose) {
  const Skeleton skeleton = makeSkeleton(performer());
  const RetargetResult result = retargeted(sourceOf({Pose::Zero(), Pose::Zero()}, skeleton), 1.0);
  for (const Pose& q : result.clip.poses) EXPECT_LT(q.cwiseAbs().maxCoeff(), 1e-4);
}

TEST(Retarget, NamingsAndUnitsDoNotMatter) {
  const Skeleton skeleton = makeSkeleton(performer());
  const std::vector<Pose> poses = smoothPoses(3, 8, 0.5);
  const std::map<std::string, std::string> poser = {
      {"Hips", "hip"},        {"Spine", "chest"},           {"Neck", "neck"},         {"Head", "head"},
      {"LeftArm", "lShldr"},  {"LeftForeArm", "lForeArm"},  {"LeftHand", "lHand"},    {"LeftUpLeg", "lThigh"},
      {"LeftLeg", "lShin"},   {"LeftFoot", "lFoot"},        {"LeftToeBase", "lToe"},  {"LeftShoulder", "lCollar"},
      {"RightArm", "rShldr"}, {"RightForeArm", "rForeArm"}, {"RightHand", "rHand"},   {"RightUpLeg", "rThigh"},
      {"RightLeg", "rShin"},  {"RightFoot", "rFoot"},       {"RightToeBase", "rToe"}, {"RightShoulder", "rCollar"}};
  std::map<std::string, std::string> mixamo;
  const Rig rig(RigStyle::MotionBuilder, skeleton);
  for (const MotionBone& bone : rig.bones()) mixamo[bone.name] = "mixamorig:" + bone.name;
  for (const auto& names : {poser, mixamo}) {
    SourceMotion motion = sourceOf(poses, skeleton);
    rename(motion, names);
    for (MotionBone& bone : motion.bones) bone.offset *= 100.0, bone.tip *= 100.0;
    for (MotionFrame& frame : motion.frames) {
      for (Vector3d& p : frame.position) p *= 100.0;
    }
    EXPECT_LT(worstAngle(retargeted(motion, 0.01).clip.poses, poses), 0.02);
  }
}

TEST(Retarget, ZUpFilesAreTurnedUpright) {
  const Skeleton skeleton = makeSkeleton(performer());
  const std::vector<Pose> poses = smoothPoses(3, 8, 0.5);
  SourceMotion motion = sourceOf(poses, skeleton);
  // Every rest direction and every rotation in a frame whose z is up: x stays, y becomes z.
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX()));
  for (MotionBone& bone : motion.bones) bone.offset = turn * bone.offset, bone.tip = turn * bone.tip;
  for (MotionFrame& frame : motion.frames) {
    for (Vector3d& p : frame.position) p = turn * p;
    for (auto& rotation : frame.rotation) rotation = turn * rotation * turn.conjugate();
  }
  const MotionClip clip = retargeted(motion, 1.0).clip;
  EXPECT_LT(worstAngle(clip.poses, poses), 0.02);
  EXPECT_LT((clip.poses[5] - poses[5]).head<3>().norm(), 0.005);
}

TEST(Retarget, HeadingAndTwistsAreContinuous) {
  std::vector<Pose> poses;
  for (int i = 0; i < 300; ++i) {
    Pose q = Pose::Zero();
    q[kRootRy] = 0.06 * i;  // almost three turns
    q[kLhumerusRz] = -1.3;
    q[kLhumerusRx] = std::sin(0.05 * i);  // twist of a straight arm
    q[kRradiusRy] = 0.4 + 0.4 * std::sin(0.1 * i);
    poses.push_back(q);
  }
  const MotionClip clip = retargeted(sourceOf(poses, makeSkeleton(performer())), 1.0).clip;
  for (std::size_t i = 1; i < clip.poses.size(); ++i) {
    EXPECT_LT((clip.poses[i] - clip.poses[i - 1]).cwiseAbs().maxCoeff(), 0.15) << "frame " << i;
  }
  EXPECT_NEAR(clip.poses.back()[kRootRy], poses.back()[kRootRy], 0.02);
}

TEST(Retarget, ACartwheelKeepsItsTiltWithinHalfATurn) {
  std::vector<Pose> poses;
  for (int i = 0; i <= 60; ++i) {
    Pose q = Pose::Zero();
    q[kRootRz] = 2.0 * std::numbers::pi * i / 60.0;
    q[kRootRx] = 0.1;
    poses.push_back(q);
  }
  const RetargetResult result = retargeted(sourceOf(poses, makeSkeleton(performer())), 1.0);
  for (const Pose& q : result.clip.poses)
    EXPECT_LE(Eigen::Vector2d(q[kRootRx], q[kRootRz]).norm(), std::numbers::pi + 1e-9);
  for (const double residual : result.residuals.max_m) EXPECT_LT(residual, 0.003);
}

TEST(Retarget, OneArmAndNoHeadIsAnError) {
  SourceMotion motion = sourceOf({Pose::Zero()}, makeSkeleton(performer()));
  rename(motion, {{"RightShoulder", "a"}, {"RightArm", "b"}, {"RightForeArm", "c"}, {"RightHand", "d"}, {"Head", "e"}});
  const NamedBones named = namedBones(motion.bones, {}, "test");
  EXPECT_GE(named.left.humerus, 0);
  EXPECT_EQ(named.right.humerus, -1);
  EXPECT_EQ(named.head, -1) << "no bone carries two arms";
  EXPECT_THROW(retargeted(motion, 1.0), Error);
}

TEST(Retarget, SkeletonsWithoutABodyAreErrors) {
  const Skeleton skeleton = makeSkeleton(performer());
  for (const char* missing : {"LeftForeArm", "RightUpLeg"}) {
    SourceMotion motion = sourceOf({Pose::Zero()}, skeleton);
    rename(motion, {{missing, "tail"}});
    EXPECT_NE(errorOf([&] { retargeted(motion, 1.0, "creature.bvh"); }).find("creature.bvh"), std::string::npos)
        << missing;
  }
}

class MotionFiles : public test::MotionFolder {
 protected:
  // Our poses as a BVH file.
  fs::path writeOurs(const std::string& name, const std::vector<Pose>& poses, double fps = 30.0,
                     double scale = 1.0) const {
    BvhWriter writer(file(name), makeSkeleton(performer()), fps, scale);
    for (const Pose& q : poses) writer.write(q);
    writer.finish();
    return file(name);
  }
};

TEST_F(MotionFiles, UnitsOfBvhAreFound) {
  const std::vector<Pose> poses = smoothPoses(2, 5, 0.4);
  for (const double scale : {1.0, 100.0, 1000.0, 1.0 / 0.0254, 0.45 / 0.0254}) {
    const MotionClip clip = loadMotion(writeOurs("m.bvh", poses, 30.0, scale));
    EXPECT_NEAR(clip.lengths.upper_leg, performer().upper_leg, 1e-5) << scale;
    EXPECT_LT(worstAngle(clip.poses, poses), 0.02) << scale;
  }
  LoadOptions options;
  options.bvh_metres_per_unit = 0.5;
  EXPECT_NEAR(loadMotion(writeOurs("m.bvh", poses), options).lengths.foot, 0.5 * performer().foot, 1e-5);
  EXPECT_NE(errorOf([&] { loadMotion(writeOurs("m.bvh", poses, 30.0, 1e5)); }).find("unit of length"),
            std::string::npos);
  options.bvh_metres_per_unit = -1;
  EXPECT_NE(errorOf([&] { loadMotion(file("m.bvh"), options); }).find("bvh_metres_per_unit"), std::string::npos);
}

TEST_F(MotionFiles, FastMotionsAreResampled) {
  const std::vector<Pose> poses = smoothPoses(3, 40, 0.4);
  const MotionClip clip = loadMotion(writeOurs("fast.bvh", poses, 120.0));
  EXPECT_EQ(clip.name, "fast");
  EXPECT_NEAR(clip.fps, 30.0, 1e-9);
  ASSERT_EQ(clip.poses.size(), 30U);
  for (std::size_t i = 0; i < clip.poses.size(); ++i) EXPECT_LT(worstAngle({clip.poses[i]}, {poses[4 * i]}), 0.02) << i;
  EXPECT_NEAR(loadMotion(writeOurs("slow.bvh", poses, 20.0)).fps, 20.0, 1e-4);
  EXPECT_EQ(loadMotion(writeOurs("thirty.bvh", poses, 30.0)).poses.size(), poses.size());
}

TEST_F(MotionFiles, AsfAndAmcGiveTheSamePosesAsBvh) {
  const Skeleton skeleton = makeSkeleton(performer());
  const std::vector<Pose> poses = smoothPoses(3, 8, 0.5);
  SourceMotion motion = sourceOf(poses, skeleton);
  motion.bones[0].name = "root";
  writeAsfAmc(motion, file("07.asf"), file("07_02.amc"));
  const MotionClip clip = loadMotion(file("07_02.amc"));
  EXPECT_EQ(clip.name, "07_02");
  EXPECT_LT(worstAngle(clip.poses, poses), 0.02);
  EXPECT_LT((clip.poses[4] - poses[4]).head<3>().norm(), 0.005);
  LoadOptions options;
  options.asf = file("07.asf");
  options.fps_if_unsaid = 60.0;
  fs::rename(file("07_02.amc"), file("other.amc"));
  EXPECT_EQ(loadMotion(file("other.amc"), options).poses.size(), poses.size() / 2);
  EXPECT_EQ(loadMotion(file("other.amc")).poses.size(), poses.size());  // the only skeleton of the folder
  fs::copy_file(file("07.asf"), file("08.asf"));
  EXPECT_NE(errorOf([&] { loadMotion(file("other.amc")); }).find("no ASF file"), std::string::npos);
}

TEST_F(MotionFiles, AFirstFrameFromWhichTheBodyJumpsIsReplaced) {
  std::vector<Pose> poses(6, Pose::Zero());
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i].head<3>() << 2.0, 0.9, 1.0;
    poses[i][kLhumerusRz] = -1.2 + 0.01 * static_cast<double>(i);
  }
  const fs::path path = writeOurs("jump.bvh", poses);
  const MotionClip clip = loadMotion(path);
  ASSERT_EQ(clip.poses.size(), poses.size());
  EXPECT_LT((clip.poses[0] - clip.poses[1]).cwiseAbs().maxCoeff(), 1e-3);
  LoadOptions options;
  options.repair_first_frame = false;
  EXPECT_NEAR(loadMotion(path, options).poses[0][kLhumerusRz], 0.0, 1e-3);
}

TEST_F(MotionFiles, AreFoundInOrderAndBelowLinks) {
  write("b/two.BVH", "x");
  write("a/one.amc", "x");
  write("a/one.asf", "x");
  write("notes.txt", "x");
  fs::create_directory_symlink(file("b"), file("c"));
  fs::create_directory_symlink(file(""), file("b/circle"));
  const auto files = findMotionFiles(file(""));
  ASSERT_EQ(files.size(), 2U);
  EXPECT_EQ(files[0].filename(), "one.amc");
  EXPECT_NE(errorOf([&] { findMotionFiles(file("nowhere")); }).find("nowhere"), std::string::npos);
  EXPECT_NE(errorOf([&] { loadMotion(file("notes.txt")); }).find("neither"), std::string::npos);
}

// The captured motions are no part of the repository: these tests run where they lie beside it.
class CapturedMotions : public testing::TestWithParam<const char*> {};

TEST_P(CapturedMotions, AreFittedWithinMillimetres) {
  if (test::dataFolder().empty())
    GTEST_SKIP() << "no captured motions: set DEPTHMOCAP_DATA to the folder that holds cmu/";
  const RetargetResult result = retargetMotionFile(fs::path(test::dataFolder()) / GetParam());
  for (int j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<Joint>(j);
    const bool trunk = joint == Joint::Spine || joint == Joint::Neck || joint == Joint::Head;
    EXPECT_LT(result.residuals.mean_m[static_cast<std::size_t>(j)], trunk ? 0.04 : 0.015)
        << kJointNames[static_cast<std::size_t>(j)];
  }
  EXPECT_GT(statureOf(result.clip.lengths), 1.5);
  EXPECT_LT(statureOf(result.clip.lengths), 1.95);
}

TEST(CapturedWalk, IsContinuousAndUpright) {
  if (test::dataFolder().empty())
    GTEST_SKIP() << "no captured motions: set DEPTHMOCAP_DATA to the folder that holds cmu/";
  const MotionClip clip = loadMotion(fs::path(test::dataFolder()) / "cmu/16/16_15.amc");
  Pose mean = Pose::Zero();
  for (std::size_t i = 0; i < clip.poses.size(); ++i) {
    mean += clip.poses[i] / static_cast<double>(clip.poses.size());
    if (i == 0) continue;
    EXPECT_LT((clip.poses[i] - clip.poses[i - 1]).tail<kDofCount - kFirstRotationDof>().cwiseAbs().maxCoeff(), 0.5)
        << i;
  }
  // The lean of CMU's pelvis and neck bones in their rest pose is no rotation.
  for (const Dof dof : {kRootRx, kRootRz, kUpperbackRx, kUpperbackRz, kNeckRx, kNeckRz}) {
    EXPECT_LT(std::abs(mean[dof]), 0.2) << kDofNames[dof];
  }
}

// The cgspeed conversions to BVH: other names, a T-pose first, the bone "wrist" left out, CMU's unit.
TEST_F(MotionFiles, CgspeedConversionsGiveThePosesOfAsfAndAmc) {
  if (test::dataFolder().empty())
    GTEST_SKIP() << "no captured motions: set DEPTHMOCAP_DATA to the folder that holds cmu/";
  const fs::path folder = fs::path(test::dataFolder()) / "cmu/16";
  SourceMotion motion = readAmc(folder / "16_16.amc", readAsf(folder / "16.asf"), 30.0);
  const MotionClip clip = loadMotion(folder / "16_16.amc");
  rename(motion, {{"root", "Hips"},
                  {"lhipjoint", "LHipJoint"},
                  {"lfemur", "LeftUpLeg"},
                  {"ltibia", "LeftLeg"},
                  {"lfoot", "LeftFoot"},
                  {"ltoes", "LeftToeBase"},
                  {"rhipjoint", "RHipJoint"},
                  {"rfemur", "RightUpLeg"},
                  {"rtibia", "RightLeg"},
                  {"rfoot", "RightFoot"},
                  {"rtoes", "RightToeBase"},
                  {"lowerback", "LowerBack"},
                  {"upperback", "Spine"},
                  {"thorax", "Spine1"},
                  {"lowerneck", "Neck"},
                  {"upperneck", "Neck1"},
                  {"head", "Head"},
                  {"lclavicle", "LeftShoulder"},
                  {"lhumerus", "LeftArm"},
                  {"lradius", "LeftForeArm"},
                  {"lwrist", "LeftHand"},
                  {"lhand", "LeftFingerBase"},
                  {"rclavicle", "RightShoulder"},
                  {"rhumerus", "RightArm"},
                  {"rradius", "RightForeArm"},
                  {"rwrist", "RightHand"},
                  {"rhand", "RightFingerBase"}});
  for (std::size_t b = 0; b < motion.bones.size(); ++b) {
    if (motion.bones[b].name.find("FingerBase") == std::string::npos) continue;
    motion.bones[b].offset.setZero();
    for (MotionFrame& frame : motion.frames) frame.position[b].setZero();
  }
  MotionFrame t_pose = motion.frames[0];
  for (auto& rotation : t_pose.rotation) rotation.setIdentity();
  motion.frames.insert(motion.frames.begin(), t_pose);
  writeBvh(motion, file("16_16.bvh"), 0.45 / 0.0254);
  MotionClip converted = loadMotion(file("16_16.bvh"));
  EXPECT_LT((converted.poses[0] - converted.poses[1]).cwiseAbs().maxCoeff(), 1e-3);
  converted.poses.erase(converted.poses.begin());
  ASSERT_EQ(converted.poses.size(), clip.poses.size());
  EXPECT_NEAR(converted.lengths.lower_arm, clip.lengths.lower_arm, 1e-4);
  EXPECT_LT(worstAngle(converted.poses, clip.poses), 0.02);
}

INSTANTIATE_TEST_SUITE_P(OfCmu, CapturedMotions,
                         testing::Values("cmu/02/02_01.amc", "cmu/16/16_15.amc", "cmu/16/16_35.amc", "cmu/09/09_10.amc",
                                         "cmu/49/49_06.amc", "cmu_bvh/salsa/salsa_02.bvh"));

}  // namespace
}  // namespace depthmocap

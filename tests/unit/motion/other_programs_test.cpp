// Motion files as other programs write them: each holds the motion of one of our own files, and must give its joints.
#include <array>
#include <map>
#include <regex>

#include "libtracker/motion/asf_amc.h"
#include "libtracker/motion/bvh.h"
#include "libtracker/motion/bvh_writer.h"
#include "libtracker/motion/mirrored_sides.h"
#include "libtracker/motion/motion_files.h"
#include "libtracker/motion/standing_rest.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/unit/motion/motion_test_files.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using test::errorOf;
using test::replaced;

std::string replacedAll(const std::string& text, const std::string& pattern, const std::string& to) {
  EXPECT_TRUE(std::regex_search(text, std::regex(pattern))) << pattern;
  return std::regex_replace(text, std::regex(pattern), to);
}

class OtherPrograms : public test::MotionFolder {
 protected:
  static constexpr int kFrames = 24;

  void SetUp() override {
    MotionFolder::SetUp();
    const Skeleton skeleton = makeSkeleton(BoneLengths{});
    BvhWriter writer(file("base.bvh"), skeleton, 30.0, 100.0);
    // From standing with hanging arms, which no file's T-pose is, to a bent pose and on.
    Random random(3);
    Pose from = Pose::Zero();
    from[kRootTy] = 0.93;
    from[kRhumerusRz] = 0.5;
    from[kLhumerusRz] = -0.5;
    Pose to = test::randomPose(random, 0.5);
    to.head<3>() << 0.2, 0.9, 0.1;
    to[kRootRy] = 0.4;
    for (int i = 0; i < kFrames; ++i) writer.write(from + (to - from) * (static_cast<double>(i) / kFrames));
    writer.finish();
    base_text_ = textOf(file("base.bvh"));
    base_ = loadMotion(file("base.bvh"));
  }

  // The largest distance [m] of a joint from the base's, of frames from the first.
  [[nodiscard]] double distance(const MotionClip& clip) const {
    const Skeleton a = makeSkeleton(base_.lengths);
    const Skeleton b = makeSkeleton(clip.lengths);
    double worst = 0;
    for (std::size_t f = 0; f < clip.poses.size(); ++f) {
      const JointPositions d = jointPositions(a, base_.poses.at(f)) - jointPositions(b, clip.poses[f]);
      worst = std::max(worst, d.colwise().norm().maxCoeff());
    }
    return worst;
  }

  // A text is read as the base, with a warning that holds some words; with none where they are empty.
  void expectBase(const std::string& text, const std::string& warning, std::size_t frames = kFrames,
                  const LoadOptions& options = {}) {
    const RetargetResult result = retargetMotionFile(write("a.bvh", text), options);
    EXPECT_EQ(result.clip.poses.size(), frames);
    EXPECT_NEAR(result.clip.fps, 30.0, 1e-3);
    EXPECT_LT(distance(result.clip), 0.001);
    if (warning.empty()) {
      EXPECT_TRUE(result.warnings.empty()) << result.warnings.front();
    } else {
      ASSERT_FALSE(result.warnings.empty());
      EXPECT_NE(result.warnings.front().find(warning), std::string::npos) << result.warnings.front();
    }
  }

  std::string base_text_;
  MotionClip base_;
};

TEST_F(OtherPrograms, TextLayoutsAreRead) {
  expectBase("\xEF\xBB\xBF" + base_text_, "");
  expectBase(replacedAll(base_text_, "\n", "\r"), "");
  expectBase(replacedAll(base_text_, "\n", "\r\n"), "");
  expectBase(replacedAll(replacedAll(base_text_, " +", "\t"), "JOINT", "joint"), "");
  expectBase(replacedAll(base_text_, "([0-9])\\.([0-9])", "$1,$2"), "");
}

TEST_F(OtherPrograms, RowsAreReadWhateverIsAnnounced) {
  std::string wrapped = base_text_;
  // A line's first values, then the rest: every frame's row on two lines.
  const auto rows = wrapped.find('\n', wrapped.find("Frame Time"));
  wrapped = wrapped.substr(0, rows) + replacedAll(wrapped.substr(rows), "\n((?:[-0-9.]+ ){10})", "\n$1\n");
  expectBase(wrapped, "");
  expectBase(replacedAll(base_text_, "Frames: +24", "Frames: 23"), "announces 23");
  expectBase(replacedAll(base_text_, "Frames: +24", "Frames: 0"), "announces 0");
  expectBase(base_text_.substr(0, base_text_.rfind(' ')), "cut short", kFrames - 1);
}

TEST_F(OtherPrograms, SidesOfMirroredFilesAreExchanged) {
  const std::string half = replacedAll(base_text_, "Left", "Other");
  expectBase(replacedAll(replacedAll(half, "Right", "Left"), "Other", "Right"), "mirrored");
}

// A program that mirrors a motion by a scale of -1 turns the body, too: its names are right, its geometry is not.
TEST_F(OtherPrograms, MirroredGeometryIsSeen) {
  SourceMotion motion = readBvh(file("base.bvh"), 30.0);
  const NamedBones named = namedBones(motion.bones, {}, "base");
  EXPECT_FALSE(sidesAreMirrored(motion, named));
  for (MotionBone& bone : motion.bones) bone.offset.x() *= -1;
  for (MotionFrame& frame : motion.frames) {
    for (Vector3d& p : frame.position) p.x() *= -1;
    for (Eigen::Quaterniond& q : frame.rotation) q = Eigen::Quaterniond(q.w(), q.x(), -q.y(), -q.z());
  }
  EXPECT_TRUE(sidesAreMirrored(motion, named));
}

TEST_F(OtherPrograms, FrameTimesInOtherUnits) {
  expectBase(replaced(base_text_, "0.03333333", "0"), "frame time is 0");
  expectBase(replaced(base_text_, "0.03333333", "33333.333"), "microseconds");
  expectBase(replaced(base_text_, "0.03333333", "33.333333"), "milliseconds");
  expectBase(replaced(base_text_, "0.03333333", "30"), "frames a second");
  LoadOptions options;
  options.fps_if_unsaid = 15.0;
  EXPECT_EQ(loadMotion(write("a.bvh", replaced(base_text_, "0.03333333", "0")), options).fps, 15.0);
}

TEST_F(OtherPrograms, ScaleChannelsAndSecondRootsArePassedOver) {
  std::string text = replacedAll(base_text_, "CHANNELS 3 (.*)", "CHANNELS 6 $1 Xscale Yscale Zscale");
  const auto rows = text.find('\n', text.find("Frame Time"));
  // After the root's six values every three are a joint's.
  const std::string values = replacedAll(text.substr(rows), "\n((?:\\S+ ){6})", "\n$1@");
  std::string scaled;
  int blanks = -1;
  for (const char c : values) {
    if (c == '@') {
      blanks = 0;
      continue;
    }
    if ((c == ' ' || c == '\n') && blanks >= 0 && ++blanks % 3 == 0) scaled += " 1 1 1";
    if (c == '\n') blanks = -1;
    scaled += c;
  }
  expectBase(text.substr(0, rows) + scaled, "");

  std::string prop = "ROOT Ball\n{\n OFFSET 0 0 0\n CHANNELS 3 Xposition Yposition Zposition\n}\nMOTION";
  std::string two = replaced(base_text_, "MOTION", prop);
  const auto first = two.find('\n', two.find("Frame Time"));
  two = two.substr(0, first) + replacedAll(two.substr(first), "([0-9])\n", "$1 7 8 9\n");
  expectBase(two, "several roots");
}

TEST_F(OtherPrograms, PositionChannelsThatAreMovesFromTheOffset) {
  std::string text = replacedAll(base_text_, "CHANNELS 3 ", "CHANNELS 6 Xposition Yposition Zposition ");
  const auto rows = text.find('\n', text.find("Frame Time"));
  std::string with_zeros;
  int value = 0;
  for (const char c : text.substr(rows)) {
    with_zeros += c;
    if (c == '\n') value = 0;
    if (c == ' ' && ++value >= 6 && value % 3 == 0) with_zeros += "0 0 0 ";
  }
  expectBase(text.substr(0, rows) + with_zeros, "moves from their OFFSETs");
}

TEST_F(OtherPrograms, Units) {
  const SourceMotion motion = readBvh(file("base.bvh"));
  const std::map<double, std::string> units = {{0.01, ""}, {0.3937008, ""}, {0.0328084, "feet"}, {0.1, "decimetres"}};
  for (const auto& [scale, warning] : units) {
    writeBvh(motion, file("scaled.bvh"), scale);
    expectBase(textOf(file("scaled.bvh")), warning);
  }
  writeBvh(motion, file("scaled.bvh"), 100.0);
  EXPECT_NE(errorOf([&] { loadMotion(file("scaled.bvh")); }).find("--unit"), std::string::npos);
}

// Of each program the names for: LeftArm LeftForeArm LeftHand LeftUpLeg LeftLeg LeftFoot LeftToeBase LeftShoulder Head.
using Naming = std::array<const char*, 9>;
TEST_F(OtherPrograms, Names) {
  const std::vector<Naming> namings = {
      {"upper_arm.L", "forearm.L", "hand.L", "thigh.L", "shin.L", "foot.L", "toe.L", "shoulder.L", "spine.006"},
      {"DEF-upper_arm.L", "DEF-forearm.L", "DEF-hand.L", "DEF-thigh.L", "DEF-shin.L", "DEF-foot.L", "DEF-toe.L",
       "DEF-shoulder.L", "DEF-spine.006"},
      {"upperarm_l", "lowerarm_l", "hand_l", "thigh_l", "calf_l", "foot_l", "ball_l", "clavicle_l", "head"},
      {"J_Bip_L_UpperArm", "J_Bip_L_LowerArm", "J_Bip_L_Hand", "J_Bip_L_UpperLeg", "J_Bip_L_LowerLeg", "J_Bip_L_Foot",
       "J_Bip_L_ToeBase", "J_Bip_L_Shoulder", "J_Bip_C_Head"},
      {"Bip01 L UpperArm", "Bip01 L Forearm", "Bip01 L Hand", "Bip01 L Thigh", "Bip01 L Calf", "Bip01 L Foot",
       "Bip01 L Toe0", "Bip01 L Clavicle", "Bip01 Head"},
      {"SHOULDER_LEFT", "ELBOW_LEFT", "WRIST_LEFT", "HIP_LEFT", "KNEE_LEFT", "ANKLE_LEFT", "FOOT_LEFT", "CLAVICLE_LEFT",
       "HEAD"},
      {"Character1_LeftArm", "Character1_LeftForeArm", "Character1_LeftHand", "Character1_LeftUpLeg",
       "Character1_LeftLeg", "Character1_LeftFoot", "Character1_LeftToeBase", "Character1_LeftShoulder",
       "Character1_Head"},
      {"mixamorig:LeftArm", "mixamorig:LeftForeArm", "mixamorig:LeftHand", "mixamorig:LeftUpLeg", "mixamorig:LeftLeg",
       "mixamorig:LeftFoot", "mixamorig:LeftToeBase", "mixamorig:LeftShoulder", "mixamorig:Head"},
      {"LeftArm_jnt", "LeftForeArm_jnt", "LeftHand_jnt", "LeftUpLeg_jnt", "LeftLeg_jnt", "LeftFoot_jnt",
       "LeftToeBase_jnt", "LeftShoulder_jnt", "Head_jnt"},
      {"L_Shoulder", "L_Elbow", "L_Wrist", "L_Hip", "L_Knee", "L_Ankle", "L_Foot", "L_Collar", "Head"},
      {"Bob_LUArm", "Bob_LFArm", "Bob_LHand", "Bob_LThigh", "Bob_LShin", "Bob_LFoot", "Bob_LToe", "Bob_LShoulder",
       "Bob_Head"},
      {"LeftShoulder", "LeftElbow", "LeftWrist", "LeftHip", "LeftKnee", "LeftAnkle", "LeftToe", "LeftCollar", "Head"},
      {"LeftArm", "LeftForeArm", "LeftHand", "LeftThigh", "LeftShin", "LeftFoot", "LeftToe", "LeftShoulder", "Head"},
      {"LeftUpperArm", "LeftLowerArm", "LeftHand", "LeftLeg", "LeftKnee", "LeftFoot", "LeftToe", "LeftShoulder",
       "Head"}};
  const std::array<const char*, 9> ours = {"LeftArm",  "LeftForeArm", "LeftHand",     "LeftUpLeg", "LeftLeg",
                                           "LeftFoot", "LeftToeBase", "LeftShoulder", "Head"};
  const std::map<std::string, std::string> mirrored = {{".L", ".R"},   {"_l", "_r"},      {"_L_", "_R_"},
                                                       {" L ", " R "}, {"LEFT", "RIGHT"}, {"Left", "Right"},
                                                       {"L_", "R_"},   {"_L", "_R"}};
  for (const Naming& naming : namings) {
    std::string text = base_text_;
    for (std::size_t i = 0; i < ours.size(); ++i) {
      std::string right = naming[i];
      for (const auto& [l, r] : mirrored) {
        if (const auto at = right.find(l); at != std::string::npos) {
          right.replace(at, l.size(), r);
          break;
        }
      }
      // Marked, so that a new name is not renamed again.
      text = replacedAll(text, std::string("(ROOT|JOINT) ") + ours[i] + "\n", std::string("$1 #") + naming[i] + "\n");
      if (i == 8) continue;
      const std::string ours_right = std::string(ours[i]).replace(0, 4, "Right");
      text = replacedAll(text, "(ROOT|JOINT) " + ours_right + "\n", "$1 #" + right + "\n");
    }
    SCOPED_TRACE(naming[0]);
    expectBase(replacedAll(text, "#", ""), "");
  }
}

TEST_F(OtherPrograms, ABoneMapNamesWhatNamesDoNot) {
  const std::string text = replacedAll(base_text_, "JOINT LeftUpLeg", "JOINT Linkes_Bein");
  EXPECT_NE(errorOf([&] { loadMotion(write("a.bvh", text)); }).find("--bones"), std::string::npos);
  LoadOptions options;
  options.bones = readBoneMap(write("map.json", R"({"left_upper_leg": "Linkes_Bein"})"));
  expectBase(text, "", kFrames, options);
  options.bones = readBoneMap(write("map.json", R"({"left_upper_leg": "Bein"})"));
  EXPECT_NE(errorOf([&] { loadMotion(file("a.bvh"), options); }).find("'Bein'"), std::string::npos);
  EXPECT_NE(errorOf([&] { readBoneMap(write("map.json", R"({"tail": "x"})")); }).find("'tail'"), std::string::npos);
}

TEST_F(OtherPrograms, FeetWithoutToes) {
  std::string text = base_text_;
  for (const char* side : {"Left", "Right"}) {
    text = replacedAll(text, std::string("JOINT ") + side + "ToeBase", std::string("JOINT ") + side + "Sole");
  }
  const MotionClip clip = loadMotion(write("a.bvh", text));
  const Skeleton a = makeSkeleton(base_.lengths);
  const Skeleton b = makeSkeleton(clip.lengths);
  for (std::size_t f = 0; f < clip.poses.size(); ++f) {
    const JointPositions d = jointPositions(a, base_.poses[f]) - jointPositions(b, clip.poses[f]);
    for (int j = 0; j < kJointCount; ++j) {
      const bool toe = j == static_cast<int>(Joint::LeftToe) || j == static_cast<int>(Joint::RightToe);
      EXPECT_LT(d.col(j).norm(), toe ? 0.12 : 0.02) << f << ' ' << kJointNames[static_cast<std::size_t>(j)];
    }
  }
}

// The motion with every bone's frame turned by a rotation of its own.
SourceMotion turnedFrames(SourceMotion motion, bool along_bones) {
  Random random(9);
  std::vector<Eigen::Quaterniond> turn;
  for (std::size_t b = 0; b < motion.bones.size(); ++b) {
    const Vector3d v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    Vector3d bone = motion.bones[b].has_tip ? motion.bones[b].tip : Vector3d::UnitY();
    for (std::size_t c = motion.bones.size(); c-- > b + 1;) {
      if (motion.bones[c].parent == static_cast<int>(b)) bone = motion.bones[c].offset;
    }
    turn.push_back(along_bones ? Eigen::Quaterniond::FromTwoVectors(bone, Vector3d::UnitX())
                               : Eigen::Quaterniond(Eigen::AngleAxisd(2.5, v.normalized())));
  }
  for (std::size_t b = 0; b < motion.bones.size(); ++b) {
    const auto parent = motion.bones[b].parent < 0 ? Eigen::Quaterniond::Identity()
                                                   : turn[static_cast<std::size_t>(motion.bones[b].parent)];
    motion.bones[b].offset = parent * motion.bones[b].offset;
    motion.bones[b].tip = turn[b] * motion.bones[b].tip;
    for (MotionFrame& frame : motion.frames) {
      frame.position[b] = parent * frame.position[b];
      frame.rotation[b] = parent * frame.rotation[b] * turn[b].conjugate();
    }
  }
  return motion;
}

TEST_F(OtherPrograms, JointAxesAlongTheBonesOrAnywhere) {
  for (const bool along : {true, false}) {
    writeBvh(turnedFrames(readBvh(file("base.bvh")), along), file("turned.bvh"));
    const RetargetResult result = retargetMotionFile(file("turned.bvh"));
    EXPECT_LT(distance(result.clip), 0.01) << along;
    ASSERT_EQ(result.warnings.size(), 1U);
    EXPECT_NE(result.warnings[0].find("no standing pose"), std::string::npos);
  }
}

// All bones turned at the root only: the rest pose stands along z, the motion along y.
TEST_F(OtherPrograms, ARestPoseThatStandsAlongAnotherAxisThanTheMotion) {
  SourceMotion motion = readBvh(file("base.bvh"));
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()));
  for (std::size_t b = 0; b < motion.bones.size(); ++b) {
    motion.bones[b].offset = turn * motion.bones[b].offset;
    motion.bones[b].tip = turn * motion.bones[b].tip;
    for (MotionFrame& frame : motion.frames) {
      if (b > 0) frame.position[b] = turn * frame.position[b];
      frame.rotation[b] = (b > 0 ? turn : Eigen::Quaterniond::Identity()) * frame.rotation[b] * turn.conjugate();
    }
  }
  writeBvh(motion, file("z.bvh"));
  const RetargetResult result = retargetMotionFile(file("z.bvh"));
  EXPECT_LT(distance(result.clip), 0.001);
  ASSERT_EQ(result.warnings.size(), 1U);
  EXPECT_NE(result.warnings[0].find("another axis"), std::string::npos);
}

TEST_F(OtherPrograms, AsfAndAmcWithWhatIsNotUsed) {
  const std::string stretch = replaced(test::kAsf, "dof rx ry rz", "dof rx ry rz l");
  const AsfSkeleton skeleton = readAsf(write("a.asf", "\xEF\xBB\xBF" + stretch));
  const std::string amc = replaced(replaced(test::kAmc, "up 0 0 0", "up 0 0 0 5"), "up 90 0 90", "up 90 0 90 5");
  const SourceMotion with = readAmc(write("a.amc", "\xEF\xBB\xBF" + amc), skeleton, 30.0);
  const SourceMotion without = readAmc(write("b.amc", test::kAmc), readAsf(write("b.asf", test::kAsf)), 30.0);
  EXPECT_TRUE(with.frames[1].rotation[1].isApprox(without.frames[1].rotation[1]));
  EXPECT_EQ(with.frames[1].position[1], without.frames[1].position[1]);

  const SourceMotion rigid =
      readAmc(write("c.amc", replacedAll(test::kAmc, "left [0-9]+\n", "")), readAsf(file("b.asf")), 30.0);
  EXPECT_EQ(rigid.frames.size(), 2U);
  ASSERT_EQ(rigid.warnings.size(), 1U);
  EXPECT_NE(rigid.warnings[0].find("bone left"), std::string::npos);
  const SourceMotion cut = readAmc(write("d.amc", replaced(test::kAmc, "left 90\n", "")), readAsf(file("b.asf")), 30.0);
  EXPECT_EQ(cut.frames.size(), 1U);
  EXPECT_EQ(cut.warnings.size(), 1U);
}

}  // namespace
}  // namespace depthmocap

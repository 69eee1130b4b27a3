#include "libtracker/motion/bvh.h"

#include <cmath>
#include <sstream>

#include "libtracker/motion/bvh_writer.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/unit/motion/motion_test_files.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;
namespace fs = std::filesystem;
using test::errorOf;
using test::kBvh;
using test::replaced;

class Bvh : public test::MotionFolder {
 protected:
  [[nodiscard]] std::string error(const std::string& text) const {
    return errorOf([&] { readBvh(write("a.bvh", text)); });
  }
  static GlobalFrame at(const SourceMotion& motion, std::size_t frame) {
    GlobalFrame global;
    globalFrame(motion.bones, motion.frames[frame], global);
    return global;
  }
  // The 18 joints of a motion with our names.
  static JointPositions joints(const SourceMotion& motion, std::size_t frame) {
    constexpr std::array<const char*, kJointCount> kNames = {
        "Hips",     "Spine",       "Neck",         "Head",      "LeftArm",   "LeftForeArm",
        "LeftHand", "RightArm",    "RightForeArm", "RightHand", "LeftUpLeg", "LeftLeg",
        "LeftFoot", "LeftToeBase", "RightUpLeg",   "RightLeg",  "RightFoot", "RightToeBase"};
    const GlobalFrame global = at(motion, frame);
    JointPositions positions;
    for (int j = 0; j < kJointCount; ++j) {
      const int bone = motion.find(kNames[static_cast<std::size_t>(j)]);
      positions.col(j) = global.position.at(static_cast<std::size_t>(bone));
      // The crown is the head's End Site, or a bone where bones move; the joint of the contract is the centre.
      if (j == 3) positions.col(j) = global.point(bone, 0.5 * motion.bones[static_cast<std::size_t>(bone)].tip);
      const int crown = motion.find("HeadTop_End");
      if (j == 3 && crown >= 0) {
        positions.col(j) = 0.5 * (global.position.at(static_cast<std::size_t>(bone)) +
                                  global.position.at(static_cast<std::size_t>(crown)));
      }
    }
    return positions;
  }
};

TEST_F(Bvh, ChannelsMultiplyInTheirOrder) {
  const SourceMotion motion = readBvh(write("a.bvh", kBvh));
  ASSERT_EQ(motion.frames.size(), 2U);
  EXPECT_NEAR(motion.fps, 30.0, 1e-3);
  EXPECT_LT((at(motion, 0).point(1, motion.bones[1].tip) - Vector3d(3, 0, 0)).norm(), 1e-12);
  // Root Rz(90) Rx(90): x -> y, z -> Rx: -y -> Rz: x. The arm's own turn about x leaves its direction alone.
  const GlobalFrame second = at(motion, 1);
  EXPECT_LT((second.point(1, motion.bones[1].tip) - Vector3d(1, 2 + 3, 3)).norm(), 1e-12);
  EXPECT_LT((second.rotation[0] * Vector3d::UnitZ() - Vector3d::UnitX()).norm(), 1e-12);
}

TEST_F(Bvh, PositionChannelsOfAJointReplaceItsOffset) {
  std::string text =
      replaced(kBvh, "CHANNELS 3 Zrotation Yrotation Xrotation", "CHANNELS 3 Zposition Yposition Xposition");
  text = replaced(text, "1 2 3 90 90 0 0 0 90", "0 0 0 0 0 0 7 8 9");
  EXPECT_EQ(at(readBvh(write("a.bvh", text)), 1).position[1], Vector3d(9, 8, 7));
}

TEST_F(Bvh, LayoutAndUnknownKeywordsDoNotMatter) {
  std::string text = replaced(kBvh, "ROOT Hips\n{", "ROOT My Hips {\n  COLOUR 1 2 3");
  text = replaced(text, "End Site", "END SITE");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const SourceMotion motion = readBvh(write("a.bvh", windows));
  EXPECT_EQ(motion.bones[0].name, "My_Hips");
  EXPECT_EQ(motion.frames.size(), 2U);
}

TEST_F(Bvh, ErrorsNameFileLineAndFault) {
  EXPECT_NE(error(replaced(kBvh, "OFFSET 1 0 0", "OFFSET 1 x 0")).find("a.bvh:8: 'x' stands where"), std::string::npos);
  EXPECT_NE(error(replaced(kBvh, "1 2 3 90 90 0 0 0 90", "1 2 3 90 90 0 0 0\n0 0 0 0 0 0 0 0 0"))
                .find("a.bvh:20: the row has 8 values"),
            std::string::npos);
  EXPECT_NE(error(replaced(kBvh, "0 0 0 0 0 0 0 0 0\n", "0 0 0 0 0 0 0 0\n")).find("value missing"), std::string::npos);
  EXPECT_NE(error(kBvh.substr(0, kBvh.find("0 0 0 0 0 0 0 0 0"))).find("no whole row"), std::string::npos);
  EXPECT_NE(error("\xFF\xFE" + kBvh).find("UTF-16"), std::string::npos);
  EXPECT_NE(error(replaced(kBvh, "CHANNELS 6", "CHANNELS 10")).find("0 to 9"), std::string::npos);
  EXPECT_NE(error(replaced(kBvh, "Xposition", "Wposition")).find("unknown channel"), std::string::npos);
  EXPECT_NE(error(replaced(kBvh, "Yposition", "Xposition")).find("twice"), std::string::npos);
  EXPECT_NE(error(replaced(kBvh, "}\nMOTION", "MOTION")).find("braces"), std::string::npos);
  EXPECT_NE(error(replaced(kBvh, "HIERARCHY", "HELLO")).find("is this a BVH file"), std::string::npos);
  EXPECT_NE(error(""), "");
  EXPECT_NE(errorOf([&] { readBvh(file("missing.bvh")); }).find("missing.bvh"), std::string::npos);
}

TEST_F(Bvh, WrittenMotionReadsBackTheSame) {
  const SourceMotion motion = readBvh(write("a.bvh", kBvh));
  writeBvh(motion, file("b.bvh"), 100.0);
  const SourceMotion again = readBvh(file("b.bvh"));
  ASSERT_EQ(again.frames.size(), 2U);
  EXPECT_NEAR(again.fps, motion.fps, 1e-4);
  for (std::size_t f = 0; f < 2; ++f) {
    EXPECT_LT((0.01 * at(again, f).point(1, again.bones[1].tip) - at(motion, f).point(1, motion.bones[1].tip)).norm(),
              1e-5);
  }
}

TEST_F(Bvh, WriterKeepsJointPositions) {
  const Skeleton skeleton = makeSkeleton(averageBoneLengths(1.62));
  Random random(5);
  std::vector<Pose> poses;
  for (int i = 0; i < 40; ++i) poses.push_back(test::randomPose(random, 1.0));
  for (const double scale : {1.0, 100.0}) {
    BvhWriter writer(file("ours.bvh"), skeleton, 25.0, scale);
    for (const Pose& q : poses) writer.write(q);
    EXPECT_FALSE(fs::exists(file("ours.bvh")));
    writer.finish();
    const SourceMotion motion = readBvh(file("ours.bvh"));
    EXPECT_NEAR(motion.fps, 25.0, 1e-4);
    ASSERT_EQ(motion.frames.size(), poses.size());
    for (std::size_t f = 0; f < poses.size(); ++f) {
      const JointPositions difference = joints(motion, f) / scale - jointPositions(skeleton, poses[f]);
      EXPECT_LT(difference.colwise().norm().maxCoeff(), 1e-4) << "frame " << f;
    }
    fs::remove(file("ours.bvh"));
  }
}

TEST_F(Bvh, BonesMayMoveWhileTheSizeIsFound) {
  const BoneLengths lengths = averageBoneLengths(1.8);
  Random random(7);
  const Pose q = test::randomPose(random, 1.0);
  BvhWriter writer(file("moving.bvh"), makeSkeleton(lengths), 30.0, 1.0, true);
  for (const double scale : {0.9, 1.0}) writer.write(q, makeSkeleton(lengths.scaled(scale)));
  writer.finish();
  const SourceMotion motion = readBvh(file("moving.bvh"));
  for (std::size_t f = 0; f < 2; ++f) {
    const JointPositions difference =
        joints(motion, f) - jointPositions(makeSkeleton(lengths.scaled(f == 0 ? 0.9 : 1.0)), q);
    EXPECT_LT(difference.colwise().norm().maxCoeff(), 1e-4) << "frame " << f;
  }
}

TEST_F(Bvh, EulerAnglesAreContinuous) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  BvhWriter writer(file("spin.bvh"), skeleton, 30.0);
  Pose q = Pose::Zero();
  constexpr int kFrames = 400;
  for (int i = 0; i < kFrames; ++i) {
    q[kRootRy] = 0.05 * i;  // three turns, through the gimbal's +-90 degrees
    q[kRhumerusRz] = 1.8 * std::sin(0.05 * i);
    q[kLhumerusRy] = 1.6 * std::sin(0.03 * i);
    writer.write(q);
  }
  writer.finish();
  const std::string text = test::MotionFolder::textOf(file("spin.bvh"));
  std::istringstream rows(text.substr(text.find("Frame Time:")));
  std::string line;
  std::getline(rows, line);
  std::vector<double> before;
  int frames = 0;
  while (std::getline(rows, line)) {
    std::istringstream values(line);
    std::vector<double> row;
    for (double value = 0; values >> value;) row.push_back(value);
    for (std::size_t i = 3; i < before.size(); ++i) {
      EXPECT_LT(std::abs(row[i] - before[i]), 45.0) << "frame " << frames << " value " << i;
    }
    before = row;
    ++frames;
  }
  EXPECT_EQ(frames, kFrames);
}

TEST_F(Bvh, WithoutFinishThereIsNoFile) {
  {
    BvhWriter writer(file("half.bvh"), makeSkeleton(BoneLengths{}), 30.0);
    writer.write(Pose::Zero());
  }
  EXPECT_TRUE(fs::is_empty(file("half.bvh").parent_path()));
  EXPECT_NE(errorOf([&] { BvhWriter(file("no/such/folder.bvh"), makeSkeleton(BoneLengths{}), 30.0); }), "");
}

// Joints without channels cost nothing in the file and as much as others in memory.
TEST_F(Bvh, RefusesFarMoreJointsTimesFramesThanValues) {
  std::string text = "HIERARCHY\nROOT Hips\n{\nOFFSET 0 0 0\nCHANNELS 1 Xrotation\n";
  for (int i = 0; i < 900; ++i) text += "JOINT j" + std::to_string(i) + "\n{\nOFFSET 0 0 0\nCHANNELS 0\n}\n";
  text += "}\nMOTION\nFrames: 100000\nFrame Time: 0.03\n";
  for (int i = 0; i < 100'000; ++i) text += "0\n";
  EXPECT_NE(error(text).find("far more frames of joints than values"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/motion/asf_amc.h"

#include "tests/unit/motion/motion_test_files.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;
using test::errorOf;
using test::kAmc;
using test::kAsf;
using test::replaced;

constexpr double kUnit = 0.0254 / 0.45;  // [m]

class AsfAmc : public test::MotionFolder {
 protected:
  SourceMotion read(const std::string& asf, const std::string& amc) const {
    return readAmc(write("a.amc", amc), readAsf(write("a.asf", asf)), 30.0);
  }
  [[nodiscard]] std::string asfError(const std::string& asf) const {
    return errorOf([&] { readAsf(write("a.asf", asf)); });
  }
  [[nodiscard]] std::string amcError(const std::string& amc) const {
    return errorOf([&] { read(kAsf, amc); });
  }
  static GlobalFrame at(const SourceMotion& motion, std::size_t frame) {
    GlobalFrame global;
    globalFrame(motion.bones, motion.frames[frame], global);
    return global;
  }
};

TEST_F(AsfAmc, BonesAreInMetresAndBeginWhereTheirParentEnds) {
  const AsfSkeleton skeleton = readAsf(write("a.asf", kAsf));
  ASSERT_EQ(skeleton.bones.size(), 3U);
  EXPECT_EQ(skeleton.bones[2].name, "left");
  EXPECT_EQ(skeleton.bones[2].parent, 1);
  EXPECT_LT((skeleton.bones[1].tip - Vector3d(0, 0.9 * kUnit, 0)).norm(), 1e-12);
  EXPECT_LT((skeleton.bones[2].offset - skeleton.bones[1].tip).norm(), 1e-12);
}

TEST_F(AsfAmc, TurnsBonesAsAcclaimDefines) {
  const SourceMotion motion = read(kAsf, kAmc);
  ASSERT_EQ(motion.frames.size(), 2U);
  // Frame 1: the root stands at x = 0.45 units and turns by 90 degrees about z: up points to -x, left to +y.
  const GlobalFrame first = at(motion, 0);
  EXPECT_LT((first.point(1, motion.bones[1].tip) - kUnit * Vector3d(0.45 - 0.9, 0, 0)).norm(), 1e-9);
  EXPECT_LT((first.point(2, motion.bones[2].tip) - kUnit * Vector3d(0.45 - 0.9, 0.45, 0)).norm(), 1e-9);
  // Frame 2: up turns about fixed axes, first x (y to z), then z (z stays): it points to +z. left is carried along by
  // the same turns, x -> x -> y, and its own 90 degrees are about its axis: x turned by 90 about z = y, in the rest
  // pose.
  const GlobalFrame second = at(motion, 1);
  EXPECT_LT((second.point(1, motion.bones[1].tip) - kUnit * Vector3d(0, 0.9, 0.9)).norm(), 1e-9);
  // left's own turn in the rest frame: x about y by 90 degrees is -z; then Rx: -z -> y; then Rz: y -> -x.
  EXPECT_LT((second.point(2, motion.bones[2].tip) - kUnit * Vector3d(-0.45, 0.9, 0.9)).norm(), 1e-9);
}

TEST_F(AsfAmc, RadiansGiveTheSameMotion) {
  const SourceMotion degrees = read(kAsf, kAmc);
  std::string asf = replaced(kAsf, "angle deg", "angle rad");
  asf = replaced(asf, "axis 0 0 90 XYZ", "axis 0 0 1.5707963267948966 XYZ");
  std::string amc = replaced(kAmc, ":DEGREES", ":RADIANS");
  for (const char* value : {"0 0 90", "90 0 90", "left 90"}) {
    std::string radians = value;
    while (radians.find("90") != std::string::npos) radians = replaced(radians, "90", "1.57@");
    while (radians.find('@') != std::string::npos) radians = replaced(radians, "1.57@", "1.5707963267948966");
    amc = replaced(amc, value, radians);
  }
  const SourceMotion radians = read(asf, amc);
  for (std::size_t f = 0; f < 2; ++f) {
    const GlobalFrame a = at(degrees, f);
    const GlobalFrame b = at(radians, f);
    for (int bone = 0; bone < 3; ++bone) {
      const Vector3d tip = degrees.bones[static_cast<std::size_t>(bone)].tip;
      EXPECT_LT((a.point(bone, tip) - b.point(bone, tip)).norm(), 1e-9);
    }
  }
}

TEST_F(AsfAmc, RootOrderIsRead) {
  const std::string asf = replaced(kAsf, "order TX TY TZ RX RY RZ", "order RZ RY RX TZ TY TX");
  const std::string amc = replaced(replaced(kAmc, "root 0.45 0 0 0 0 90", "root 90 0 0 0 0 0.45"), "root 0 0.9 0 0 0 0",
                                   "root 0 0 0 0 0.9 0");
  const SourceMotion motion = read(asf, amc);
  EXPECT_LT((at(motion, 0).point(1, motion.bones[1].tip) - kUnit * Vector3d(0.45 - 0.9, 0, 0)).norm(), 1e-9);
  EXPECT_LT((at(motion, 1).position[0] - kUnit * Vector3d(0, 0.9, 0)).norm(), 1e-9);
}

TEST_F(AsfAmc, WindowsLineEndsUnknownKeywordsAndMissingLimitsAreFine) {
  std::string asf = replaced(kAsf, ":root", ":skin\n something\n:root");
  asf = replaced(asf, "    bodymass 1\n", "    colour red\n");
  std::string windows;
  for (const char c : asf) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(readAsf(write("w.asf", windows)).bones.size(), 3U);
}

TEST_F(AsfAmc, AsfErrorsNameFileLineAndFault) {
  EXPECT_NE(asfError(replaced(kAsf, "length 0.9", "length abc")).find("a.asf:20: 'abc' stands where"),
            std::string::npos);
  EXPECT_NE(asfError(replaced(kAsf, "  angle deg\n", "")).find("angles are deg or rad"), std::string::npos);
  EXPECT_NE(asfError(replaced(kAsf, "angle deg", "angle turns")).find("deg or rad"), std::string::npos);
  EXPECT_NE(asfError(replaced(kAsf, "up left", "up right")).find("'right'"), std::string::npos);
  EXPECT_NE(asfError(replaced(kAsf, "    up left\n", "")).find("attach"), std::string::npos);
  EXPECT_NE(asfError(replaced(kAsf, "up left", "up left left")).find("two parents"), std::string::npos);
  EXPECT_NE(asfError(replaced(kAsf, "root up", "left up")).find("attach"), std::string::npos);
  EXPECT_NE(asfError(replaced(kAsf, "name left", "name up")).find("twice"), std::string::npos);
  EXPECT_NE(asfError(replaced(kAsf, "dof rx ry rz", "dof rx w")).find("'w'"), std::string::npos);
  EXPECT_NE(asfError(replaced(kAsf, "length 0.45\n  angle", "length 0\n  angle")).find("positive"), std::string::npos);
  EXPECT_NE(asfError("").find("a.asf:1:"), std::string::npos);
  EXPECT_NE(asfError("hello world").find("section"), std::string::npos);
  EXPECT_NE(errorOf([&] { readAsf(file("missing.asf")); }).find("missing.asf"), std::string::npos);
}

TEST_F(AsfAmc, AmcErrorsNameFileLineAndFault) {
  EXPECT_NE(amcError(replaced(kAmc, "up 90 0 90", "up 90 0")).find("a.amc:10: the bone up needs 3 values"),
            std::string::npos);
  EXPECT_NE(amcError(replaced(kAmc, "left 90", "wing 90")).find("'wing'"), std::string::npos);
  EXPECT_NE(amcError(replaced(kAmc, "left 90\n", "3\nroot 0 0 0 0 0 0\n")).find("without the bone left"),
            std::string::npos);
  EXPECT_NE(amcError(replaced(kAmc, "left 90", "up 1 2 3")).find("twice"), std::string::npos);
  EXPECT_NE(amcError(replaced(kAmc, "\n2\n", "\n1\n")).find("grow"), std::string::npos);
  EXPECT_NE(amcError(replaced(kAmc, "left 90", "left nan")).find("'nan'"), std::string::npos);
  EXPECT_NE(amcError(replaced(kAmc, "left 90", "left 1e300")).find("range"), std::string::npos);
  EXPECT_NE(amcError(":DEGREES\n").find("no frame"), std::string::npos);
  EXPECT_NE(amcError("root 0 0 0 0 0 0\n").find("before the first frame"), std::string::npos);
}

TEST_F(AsfAmc, WrittenFilesReadBackTheSame) {
  SourceMotion motion = read(kAsf, kAmc);
  motion.bones[2].offset += Vector3d(0.01, 0, 0.02);  // as in BVH: a gap between parent's end and bone
  for (MotionFrame& frame : motion.frames) frame.position[2] = motion.bones[2].offset;
  writeAsfAmc(motion, file("b.asf"), file("b.amc"));
  const SourceMotion again = readAmc(file("b.amc"), readAsf(file("b.asf")), 30.0);
  ASSERT_EQ(again.frames.size(), motion.frames.size());
  for (std::size_t f = 0; f < motion.frames.size(); ++f) {
    for (const char* name : {"up", "left"}) {
      const int a = motion.find(name);
      const int b = again.find(name);
      ASSERT_GE(b, 0);
      const Vector3d tip = motion.bones[static_cast<std::size_t>(a)].tip;
      EXPECT_LT((at(motion, f).point(a, tip) - at(again, f).point(b, tip)).norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace depthmocap

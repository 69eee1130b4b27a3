#include "libtracker/output/usd.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

AnimatedPerson person(int number) {
  MotionTrack track;
  track.lengths = averageBoneLengths(1.7);
  for (int i = 0; i < 3; ++i) {
    MotionTrack::Frame frame;
    frame.time_s = 4.0 + i / 30.0;
    frame.q[kRootTx] = 0.5 * i;
    track.frames.push_back(frame);
  }
  return {number, makeBuiltinBody(track.lengths), track};
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(Usd, HoldsSkeletonMotionAndSkin) {
  const TemporaryFolder folder;
  writeUsd(folder / "a.usda", {person(1)}, 30.0, RigStyle::MotionBuilder);
  const std::string text = readBytes(folder / "a.usda");
  EXPECT_TRUE(text.starts_with("#usda 1.0\n"));
  EXPECT_NE(text.find("endTimeCode = 2.000000\n"), std::string::npos);
  EXPECT_NE(text.find("\"Hips/Spine/LeftShoulder/LeftArm/LeftForeArm/LeftHand\""), std::string::npos);
  EXPECT_NE(text.find("                1.000000: [(0.500000, 0.000000, 0.000000), "), std::string::npos);
  EXPECT_EQ(std::count(text.begin(), text.end(), '{'), std::count(text.begin(), text.end(), '}'));
  EXPECT_EQ(std::count(text.begin(), text.end(), '['), std::count(text.begin(), text.end(), ']'));
}

TEST(Usd, NamesHoldOnlyWhatUsdAllows) {
  const TemporaryFolder folder;
  writeUsd(folder / "a.usda", {person(1)}, 30.0, RigStyle::Rigify);
  EXPECT_NE(readBytes(folder / "a.usda").find("\"spine/thigh_L/shin_L/foot_L\""), std::string::npos);
  writeUsd(folder / "b.usda", {person(1)}, 30.0, RigStyle::Mixamo);
  EXPECT_NE(readBytes(folder / "b.usda").find("\"mixamorig_Hips/mixamorig_LeftUpLeg\""), std::string::npos);
}

TEST(Usd, EachPersonHasASkeleton) {
  const TemporaryFolder folder;
  writeUsd(folder / "a.usda", {person(1), person(3)}, 30.0, RigStyle::Unreal);
  const std::string text = readBytes(folder / "a.usda");
  EXPECT_EQ(count(text, "def Skeleton "), 2U);
  EXPECT_NE(text.find("def SkelRoot \"Person_3\""), std::string::npos);
  EXPECT_NE(text.find("rel skel:animationSource = </Motion/Person_3/Animation>"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap

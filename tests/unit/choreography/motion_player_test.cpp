#include "libtracker/choreography/motion_player.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/choreography/motion_reader.h"
#include "libtracker/choreography/step_numbers.h"
#include "libtracker/choreography/walk_paths.h"

namespace depthmocap {
namespace {

// Exactly what the keys say, so that frames can be compared with them.
const std::string kPlay = R"({"play": {"tempo": 1, "spread": 0}})";

const Skeleton& skeleton() {
  static const Skeleton average = makeSkeleton(BoneLengths{});
  return average;
}

BodyFrames play(const std::string& steps, int variant = 0) {
  const MotionFile file = readMotionFile(R"({
    "places": {"up_high": [0.0, 0.5, 0.1, 0.0]},
    "motions": [{"name": "nod", "variants": 1, "steps": [)" +
                                             steps + "]}]}",
                                         "a.json");
  Random random(1);
  return playMotion(file.motions[0], file.places, variant, skeleton(), random).frames;
}

std::string errorOf(const std::string& steps) {
  try {
    play(steps);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(MotionPlayer, KeysStartFromTheBaseFromAPoseOrFromTheLastKey) {
  const BodyFrames frames = play(R"({"pose": "base", "pelvis": {"y": -0.1}},
    {"pose": "bow", "spine": {"bend": 0.5}},
    {"after": 0}, {"after": 1, "spine": {"twist": 0.2}}, {"after": 1, "from": "last", "pelvis": {"y": -0.2}},
    {"after": 1, "from": "bow"},)" +
                                 kPlay);
  ASSERT_EQ(frames.size(), 91U);
  EXPECT_NEAR(frames[0].pelvis.y, -0.1, 1e-12);
  EXPECT_NEAR(frames[30].spine.twist, 0.2, 1e-12);
  EXPECT_NEAR(frames[60].spine.twist, 0.2, 1e-12);
  EXPECT_NEAR(frames[60].pelvis.y, -0.2, 1e-12);
  EXPECT_NEAR(frames[90].pelvis.y, 0.0, 1e-12);
  EXPECT_NEAR(frames[90].spine.bend, 0.5, 1e-12);
}

TEST(MotionPlayer, NumbersMayBeFormulasOfNamesAndOfThePosture) {
  const BodyFrames frames = play(R"({"let": {"depth": 0.3}},
    {"after": 0}, {"after": 1, "pelvis": {"y": "-depth", "lean": "0.1 * variant"}},
    {"after": "time", "from": "last", "pelvis": {"y": "pelvis.y + 0.05"}, "spine": {"bend": "2 * before.pelvis.lean"}},)" +
                                     kPlay,
                                 2);
  ASSERT_EQ(frames.size(), 61U);
  EXPECT_NEAR(frames[30].pelvis.y, -0.3, 1e-12);
  EXPECT_NEAR(frames[30].pelvis.lean, 0.2, 1e-12);
  EXPECT_NEAR(frames[60].pelvis.y, -0.25, 1e-12);
  EXPECT_NEAR(frames[60].spine.bend, 0.4, 1e-12);
}

TEST(MotionPlayer, RepeatsAndChooses) {
  const BodyFrames frames = play(R"({"after": 0}, {"repeat": 3, "as": "i", "steps": [
      {"after": 1, "head": {"turn": "0.1 * i"}},
      {"if": "i == 1", "then": [{"set": {"head": {"nod": 0.2}}}], "else": [{"set": {"head": {"nod": -0.2}}}]},
      {"case": "i", "of": [[{"set": {"pelvis": {"x": 0.01}}}], [{"set": {"pelvis": {"x": 0.02}}}],
                           [{"set": {"pelvis": {"x": 0.03}}}]]}]},)" +
                                 kPlay);
  ASSERT_EQ(frames.size(), 91U);
  EXPECT_NEAR(frames[60].head.turn, 0.1, 1e-12);
  EXPECT_NEAR(frames[60].head.nod, 0.2, 1e-12);
  EXPECT_NEAR(frames[90].head.nod, -0.2, 1e-12);
  EXPECT_NEAR(frames[60].pelvis.x, 0.02, 1e-12);
}

TEST(MotionPlayer, HandsGoToPlacesToNumbersAndToEachOther) {
  const BodyFrames frames = play(R"({"let": {"aside": [0.4, 0.1, 0.1, 0.0]}},
    {"after": 0, "left": "up_high", "right": "left"}, {"after": 1, "hands": "aside"},
    {"after": 1, "left": [0.4, 0.1, 0.1, 0.0]},)" +
                                 kPlay);
  EXPECT_EQ(frames[0].left_arm.elbow, frames[0].right_arm.elbow);
  EXPECT_NEAR(frames[60].left_arm.swing_z, reachArm(skeleton(), {0.4, 0.1, 0.1, 0.0}).swing_z, 1e-9);
  EXPECT_GT(std::abs(frames[0].left_arm.swing_z - frames[60].left_arm.swing_z), 0.1);
}

TEST(MotionPlayer, SwapPutsLeftForRightWhereItHolds) {
  const BodyFrames frames = play(R"({"after": 0},
    {"after": 1, "swap": 1, "left_foot": {"forward": "left_foot.forward + 0.2"}, "left": "up_high"},
    {"after": 1, "swap": 0, "left_foot": {"forward": 0.3}},)" +
                                 kPlay);
  EXPECT_NEAR(frames[30].right_foot.z, 0.2, 1e-9);
  EXPECT_NEAR(frames[30].left_foot.z, 0.0, 1e-9);
  EXPECT_NEAR(frames[60].left_foot.z, 0.3, 1e-9);
}

TEST(MotionPlayer, ArmsGoOntoAWalk) {
  const std::string walk = R"({"style": {"cycle_s": 1.2}}, {"walk": {"path": "straight", "forward": 1, "seconds": 2}})";
  const BodyFrames plain = play(walk);
  const BodyFrames carrying =
      play(walk + R"(, {"after": 0, "hands": "up_high"}, {"after": 3, "from": "last"},)" + kPlay);
  ASSERT_EQ(carrying.size(), plain.size());
  EXPECT_EQ(carrying[30].left_foot.z, plain[30].left_foot.z);
  EXPECT_EQ(carrying[30].left_arm.swing_z, carrying[0].left_arm.swing_z);
  EXPECT_NE(carrying[30].left_arm.swing_z, plain[30].left_arm.swing_z);
}

TEST(MotionPlayer, AFlightLiftsTheBodyAndMovesIt) {
  const BodyFrames frames = play(R"j({"after": 0}, {"after": 1}, {"flight": {"height": 0.2, "forward": 0.5}},
    {"after": "air_time(0.2)", "from": "last"}, {"after": 1},)j" +
                                 kPlay);
  EXPECT_EQ(frames[30].left_foot.lift, 0.0);
  EXPECT_NEAR(frames[36].left_foot.lift, 0.2, 0.01);
  EXPECT_NEAR(frames.back().pelvis.z, 0.5, 1e-9);
}

TEST(MotionPlayer, WhatCannotBePerformedIsAnErrorThatNamesTheStep) {
  const std::pair<std::string, std::string> damages[] = {
      {R"({"after": 0}, {"after": 0})", R"(/steps/1: "after" is not above 0)"},
      {R"({"after": 0}, {"after": "-0.5"})", R"(/steps/1: "after" is not above 0)"},
      {R"({"after": 1}, {"after": 1e-20})", R"(/steps/1: "after" is not above 0)"},
      {R"({"after": -1})", R"(/steps/0: "after" is not above 0)"},
      {R"({"after": 1e6})", "/steps/0: is a motion that does not end"},
      {R"({"after": "wait"})", R"(/steps/0/after "wait": "wait" is not known here)"},
      {R"({"after": 0, "pelvis": {"y": "pelvis.z.y"}})",
       R"(/steps/0/pelvis/y "pelvis.z.y": "pelvis.z.y" is not known)"},
      {R"({"after": 0, "from": "seat"})", R"(/steps/0: there is no pose "seat")"},
      {R"({"after": 0, "from": "last"})", R"(/steps/0: there is no pose "last")"},
      {R"({"after": 0, "left": "up_hihg"})", R"(/steps/0/left: "up_hihg" is no place for a hand)"},
      {R"({"after": 0, "left": "pelvis"})", R"(/steps/0/left: "pelvis" is no place for a hand)"},
      {R"({"after": 0, "spine": "seat.spine"})", R"(/steps/0/spine: "seat.spine" is no spine)"},
      {R"({"set": {"pelvis": {"y": 0}}})", "/steps/0: there is no key to set"},
      {R"({"case": 2, "of": [[{"after": 0}]]})", R"(/steps/0: "case" is 2)"},
      {R"({"case": 0.5, "of": [[{"after": 0}], [{"after": 0}]]})", R"(/steps/0: "case" is 0.5)"},
      {R"({"repeat": 1.5, "steps": [{"after": 0}]})", R"(/steps/0: "repeat" is not a whole number)"},
      {R"({"repeat": 1e9, "steps": [{"let": {"a": 1}}]})", "is a motion that does not end"},
      {R"({"after": 0}, )" + kPlay, "/steps/1: there are not two keys to play"},
      {R"({"after": 0}, {"after": 1}, {"play": {"tempo": 0}})", R"(/steps/2: "tempo" is not above 0)"},
      {R"({"after": 0}, {"after": 1}, )" + kPlay + "," + kPlay, "/steps/3: the keys are played already"},
      {R"({"after": 0}, {"after": 1})", "a.json: motion nod: has no frames"},
      {R"({"flight": {"height": -1}})", R"(/steps/0: "height" is below 0)"},
      {R"({"style": {"cycle_s": 0}}, {"walk": {"path": "straight", "forward": 1, "seconds": 1}})",
       R"(/steps/1: "cycle_s" of the style is not above 0)"},
      {R"({"walk": {"path": "straight", "forward": 1, "seconds": 1e9}})",
       R"(/steps/0: "seconds" makes the motion too short or too long)"},
      {R"({"orbit": {"center": "up_high", "out": 0.1, "up": 0.1, "forward": 0, "round_s": -1, "rounds": 3}})",
       R"(/steps/0: "round_s" makes the motion too short)"},
  };
  for (const auto& [steps, expected] : damages) {
    const std::string error = errorOf(steps);
    EXPECT_EQ(error.find("a.json: motion nod: "), 0U) << steps << "\n" << error;
    EXPECT_NE(error.find(expected), std::string::npos) << steps << "\n" << error;
  }
}

std::string referencePage() {
  std::ifstream stream(DEPTHMOCAP_SOURCE_DIR "/docs/reference/motions.md");
  return {std::istreambuf_iterator<char>(stream), {}};
}

// The indented lines of the page: the example.
std::string exampleOf(const std::string& page) {
  std::istringstream lines(page);
  std::string example;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("    ")) example += line + "\n";
  }
  return example;
}

TEST(MotionFormat, TheExampleOfTheReferencePagePlays) {
  const MotionFile file = readMotionFile(exampleOf(referencePage()), "motions.md");
  ASSERT_EQ(file.motions.size(), 1U);
  for (int variant = 0; variant < file.motions[0].variants; ++variant) {
    Random random(1);
    EXPECT_GT(playMotion(file.motions[0], file.places, variant, skeleton(), random).frames.size(), 60U);
  }
}

TEST(MotionFormat, TheReferencePageHasEveryName) {
  const std::string page = referencePage();
  const auto expectNames = [&](const std::vector<std::string>& names) {
    for (const std::string& name : names) EXPECT_NE(page.find("`" + name + "`"), std::string::npos) << name;
  };
  for (const PostureGroup& group : postureGroups()) {
    expectNames({std::string(group.name)});
    expectNames({group.fields.begin(), group.fields.end()});
  }
  std::vector<const NumberNames*> steps = {&playNumbers(), &flightNumbers(), &orbitNumbers(), &strokesNumbers()};
  expectNames(walkPathNames());
  for (const std::string& path : walkPathNames()) steps.push_back(walkNumbers(path));
  for (const NumberNames* numbers : steps) {
    expectNames(numbers->required);
    expectNames(numbers->optional);
  }
}

}  // namespace
}  // namespace depthmocap

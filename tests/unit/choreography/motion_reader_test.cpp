#include "libtracker/choreography/motion_reader.h"

#include <string>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/choreography/motion_player.h"

namespace depthmocap {
namespace {

std::string fileWith(const std::string& steps) {
  return R"({"motions": [{"name": "nod", "variants": 1, "steps": [)" + steps + "]}]}";
}

std::string errorOf(const std::string& text) {
  try {
    readMotionFile(text, "a.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

struct Damage {
  std::string text;
  std::string error;  // the beginning
};

TEST(MotionReader, DamagedFilesAreErrorsThatNameFileAndKey) {
  const Damage damages[] = {
      {"", "a.json: is not valid JSON"},
      {"{", "a.json: is not valid JSON"},
      {"[]", "a.json: must hold a JSON object"},
      {"{}", "a.json: is empty"},
      {R"({"motion": []})", R"(a.json: "motion" is not known here (did you mean "motions"?))"},
      {R"({"motions": []})", "a.json: /motions: is empty"},
      {R"({"motions": {}})", "a.json: /motions: must be a list"},
      {R"({"motions": [], "motions": []})", R"(a.json: "motions" stands twice in one object)"},
      {R"({"motions": [{"variants": 1}]})", R"(a.json: /motions/0: "name" is missing)"},
      {R"({"motions": [{"name": 1}]})", "a.json: /motions/0/name: must be a text"},
      {R"({"motions": [{"name": "Nod"}]})", R"(a.json: /motions/0/name: "Nod" is no name)"},
      {R"({"motions": [{"name": "nod", "variants": 0, "steps": []}]})",
       "a.json: motion nod: /variants: must be a whole number from 1 to 100"},
      {R"({"motions": [{"name": "nod", "variants": 1, "steps": []}]})", "a.json: motion nod: /steps: is empty"},
      {R"({"motions": [{"name": "nod", "variants": 1, "step": []}]})",
       R"(a.json: motion nod: "step" is not known here (did you mean "steps"?))"},
      {R"({"places": {"here": [1, 2, 3]}})", "a.json: /places/here: must have 4 numbers"},
      {R"({"places": {"here": [1, 2, 3, "x"]}})", "a.json: /places/here/3: must be a number"},
      {R"({"places": {"left": [1, 2, 3, 4]}})", R"(a.json: /places/left: "left" has a meaning already)"},
      {R"({"parts": {"bow": {"steps": [{"part": "bow"}]}}})",
       R"(a.json: part bow: /steps/0/part: there is no part "bow" before)"},
      {std::string(10000, '[') + std::string(10000, ']'), "a.json: is nested too deeply"},
  };
  for (const Damage& damage : damages) EXPECT_EQ(errorOf(damage.text).find(damage.error), 0U) << errorOf(damage.text);
}

TEST(MotionReader, DamagedStepsAreErrorsThatNameMotionAndKey) {
  const Damage damages[] = {
      {"1", "/steps/0: must be an object"},
      {"{}", "/steps/0: is empty"},
      {R"({"aftr": 1})", R"(/steps/0: "aftr" is not known here (did you mean "after"?))"},
      {R"({"after": 1, "pelvs": {"y": 1}})", R"(/steps/0: "pelvs" is not known here (did you mean "pelvis"?))"},
      {R"({"after": 1, "pelvis": {"leen": 1}})", R"(/steps/0/pelvis: "leen" is not known here (did you mean "lean"?))"},
      {R"({"after": 1, "pelvis": {}})", "/steps/0/pelvis: is empty"},
      {R"({"after": 1, "pelvis": 3})", "/steps/0/pelvis: must be an object, a list of numbers or the name of another"},
      {R"({"after": 1, "left": [1, 2]})", "/steps/0/left: must have 4 numbers"},
      {R"({"after": 1, "left": [1, 2, true, 4]})", "/steps/0/left/2: must be a number or a formula"},
      {R"({"after": 1, "left": {"case": 0, "of": []}})", "/steps/0/left/of: is empty"},
      {R"({"after": null})", "/steps/0/after: must be a number or a formula"},
      {R"({"after": "1 +"})", R"(/steps/0/after "1 +": a number or a name is missing)"},
      {R"({"after": 1, "from": 2})", "/steps/0/from: must be a text"},
      {R"({"after": 1, "let": {"a": 1}})", R"(/steps/0: "after" is not known here)"},
      {R"({"let": {"pi": 3}})", R"(/steps/0/let/pi: "pi" has a meaning already)"},
      {R"({"let": {"a b": 3}})", R"(/steps/0/let/a b: "a b" is no name)"},
      {R"({"pose": "last"})", R"(/steps/0/pose: "last" has a meaning already)"},
      {R"({"set": {"swap": 1}})", R"(/steps/0/set: "swap" is not known here)"},
      {R"({"repeat": 2})", R"(/steps/0: "steps" is missing)"},
      {R"({"if": 1, "else": []})", "/steps/0/else: is empty"},
      {R"({"if": 1})", R"(/steps/0: "then" is missing)"},
      {R"({"case": 1})", R"(/steps/0: "of" is missing)"},
      {R"({"part": "bow"})", R"(/steps/0/part: there is no part "bow" before)"},
      {R"({"play": {"sprad": 1}})", R"(/steps/0/play: "sprad" is not known here (did you mean "spread"?))"},
      {R"({"flight": {}})", R"(/steps/0/flight: "height" is missing)"},
      {R"({"style": {"duti": 1}})", R"(/steps/0/style: "duti" is not known here (did you mean "duty"?))"},
      {R"({"walk": {"path": "strait"}})",
       R"(/steps/0/walk/path: there is no path "strait" (did you mean "straight"?))"},
      {R"({"walk": {"path": "straight", "forward": 1}})", R"(/steps/0/walk: "seconds" is missing)"},
      {R"({"orbit": {"center": "overhead", "out": 1}})", R"(/steps/0/orbit: "up" is missing)"},
      {R"({"strokes": {"center": [0, 0, 0, 0], "width": 1, "height": 1, "stroke_s": 1, "points": [[0, 0]]}})",
       "/steps/0/strokes/points: must have 2 points or more"},
      {R"({"about": "nothing"})", "/steps/0: has no kind of step"},
  };
  for (const Damage& damage : damages) {
    const std::string error = errorOf(fileWith(damage.text));
    const std::string expected = "a.json: motion nod: " + damage.error;
    EXPECT_EQ(error.find(expected), 0U) << damage.text << "\n" << error;
  }
}

TEST(MotionReader, RefusesASecondMotionOrPlaceOfTheSameName) {
  const std::string motion = R"({"name": "nod", "variants": 1, "steps": [{"after": 0}]})";
  EXPECT_EQ(errorOf(R"({"motions": [)" + motion + "," + motion + "]}"),
            R"(a.json: /motions/1: there is another motion "nod")");
  const MotionFile shared = readMotionFile(R"({"places": {"here": [0, 0, 0, 0]}})", "shared.json");
  EXPECT_THROW(readMotionFile(R"({"places": {"here": [1, 0, 0, 0]}})", "a.json", shared), Error);
}

TEST(MotionReader, ReadsNamesVariantsAndParts) {
  const MotionFile file = readMotionFile(R"({
    "about": "an example",
    "parts": {"pause": {"steps": [{"after": 1, "from": "last"}]}},
    "motions": [{"name": "nod", "variants": 2, "about": "yes", "steps": [{"after": 0}, {"part": "pause"}, {"play": {}}]}]
  })",
                                         "a.json");
  ASSERT_EQ(file.motions.size(), 1U);
  EXPECT_EQ(file.motions[0].name, "nod");
  EXPECT_EQ(file.motions[0].variants, 2);
  EXPECT_EQ(file.motions[0].steps.size(), 3U);
}

}  // namespace
}  // namespace depthmocap

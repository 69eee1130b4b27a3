#include "libtracker/core/json_file.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

std::string nested(int levels) {
  std::string text = "{\"a\":";
  for (int i = 1; i < levels; ++i) text += '[';
  for (int i = 1; i < levels; ++i) text += ']';
  return text + "}";
}

TEST(Json, RefusesDeepNesting) {
  EXPECT_EQ(errorOf([] { parseJson(nested(kMostJsonLevels), "f"); }), "");
  for (const int levels : {kMostJsonLevels + 1, 20'000, 1'000'000}) {
    EXPECT_EQ(errorOf([&] { parseJson(nested(levels), "f"); }), "f: is nested too deeply") << levels;
    EXPECT_EQ(errorOf([&] { parseOrderedJson(nested(levels), "f"); }), "f: is nested too deeply") << levels;
  }
}

TEST(Json, RefusesOneMemberTwice) {
  EXPECT_EQ(errorOf([] { parseJson(R"({"b": {"a": 1, "a": 2}})", "f"); }), "f: \"a\" stands twice in one object");
}

TEST(Json, RefusesWhatIsNoObject) {
  for (const char* text : {"[]", "1", "null"}) {
    EXPECT_EQ(errorOf([&] { parseJson(text, "f"); }), "f: must hold a JSON object");
  }
  for (const char* text : {"", "{", "{} x", "{\"a\": 1e999}", "{\"a\": nan}"}) {
    EXPECT_NE(errorOf([&] { parseJson(text, "f"); }).find("f: is not valid JSON"), std::string::npos) << text;
  }
}

TEST(Json, SaysWhatIsWrongInOneShortLine) {
  const std::string message = errorOf([] { parseJson("{\"" + std::string(100'000, 'x') + "\n\x1b[2J", "f"); });
  EXPECT_LT(message.size(), 400U);
  EXPECT_EQ(message.find_first_of("\n\x1b"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap

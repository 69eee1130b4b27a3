#include "libtracker/choreography/expression.h"

#include <cmath>

#include <gtest/gtest.h>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

double valueOf(const std::string& text, Random& random) {
  const auto names = [](std::string_view name) -> std::optional<double> {
    if (name == "depth") return 0.4;
    if (name == "pelvis.y") return -0.1;
    return std::nullopt;
  };
  return Expression(text, "here").evaluate({random, names});
}
double valueOf(const std::string& text) {
  Random random(1);
  return valueOf(text, random);
}
std::string errorOf(const std::string& text) {
  try {
    valueOf(text);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST(Expression, HasTheUsualPrecedence) {
  EXPECT_EQ(valueOf("1 + 2 * 3"), 7.0);
  EXPECT_EQ(valueOf("(1 + 2) * 3"), 9.0);
  EXPECT_EQ(valueOf("8 - 2 - 1"), 5.0);
  EXPECT_EQ(valueOf("8 / 4 / 2"), 1.0);
  EXPECT_EQ(valueOf("-2 * -3"), 6.0);
  EXPECT_EQ(valueOf("7 % 4 < 2"), 0.0);
  EXPECT_EQ(valueOf("1 == 2 ? 10 : 3 > 2 ? 20 : 30"), 20.0);
  EXPECT_EQ(valueOf("1 != 2"), 1.0);
}

TEST(Expression, KnowsNamesAndFunctions) {
  EXPECT_DOUBLE_EQ(valueOf("0.2 + 0.9 * depth"), 0.2 + 0.9 * 0.4);
  EXPECT_EQ(valueOf("pelvis.y - 0.05"), -0.1 - 0.05);
  EXPECT_DOUBLE_EQ(valueOf("sin(pi / 2) + cos(0) + asin(0) + min(1, 2) + max(1, 2)"), 5.0);
  EXPECT_DOUBLE_EQ(valueOf("degrees(180)"), std::acos(-1.0));
  EXPECT_NEAR(valueOf("air_time(0.3)"), 0.4946, 1e-4);
}

TEST(Expression, DrawsFromLeftToRight) {
  Random drawn(5), plain(5);
  const double a = plain.uniform(1, 2);
  const double b = 3 * plain.uniform(0.85, 1.15);
  EXPECT_EQ(valueOf("uniform(1, 2) - near(3)", drawn), a - b);
  EXPECT_EQ(valueOf("below(7)", drawn), plain.below(7));
  EXPECT_EQ(valueOf("near(2, 0.5)", drawn), 2 * plain.uniform(0.5, 1.5));
  EXPECT_EQ(valueOf("chance(0.5)", drawn), plain.uniform() < 0.5 ? 1.0 : 0.0);
}

TEST(Expression, DrawsOnlyInTheBranchThatIsTaken) {
  Random drawn(5), plain(5);
  EXPECT_EQ(valueOf("1 ? 4 : uniform(0, 1)", drawn), 4.0);
  EXPECT_EQ(drawn.next(), plain.next());
}

TEST(Expression, ErrorsNameThePlaceTheFormulaAndTheWord) {
  EXPECT_EQ(errorOf("1 + dept"), "here \"1 + dept\": \"dept\" is not known here (name it by a \"let\" before)");
  EXPECT_EQ(errorOf("unifrom(1, 2)"),
            "here \"unifrom(1, 2)\": there is no function \"unifrom\" (did you mean \"uniform\"?)");
  EXPECT_EQ(errorOf("uniform(1)"), "here \"uniform(1)\": \"uniform\" does not take 1 numbers");
  EXPECT_EQ(errorOf("1 / 0"), "here \"1 / 0\": is not finite");
  EXPECT_EQ(errorOf("below(0)"), "here \"below(0)\": is not finite");
}

TEST(Expression, RefusesWhatIsNoFormula) {
  for (const char* text : {"", "1 +", "(1", "1 2", "1 ? 2", "sin()", "sin(1", "1 & 2", "Depth", "a b", "uniform(1,)"}) {
    EXPECT_EQ(errorOf(text).find("here \""), 0U) << text << ": " << errorOf(text);
  }
  EXPECT_NE(errorOf(std::string(100000, '(')).find("nested too deeply"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap

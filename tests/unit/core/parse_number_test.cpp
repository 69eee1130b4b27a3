#include "libtracker/core/parse_number.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

TEST(ParseNumber, ReadsWholeNumbersAndDecimals) {
  EXPECT_EQ(parseDouble(" -1.5e-3\t"), -1.5e-3);
  EXPECT_EQ(parseDouble("7"), 7.0);
  EXPECT_EQ(parseInteger("-12"), -12);
}

TEST(ParseNumber, RefusesTextThatIsNotANumberAsAWhole) {
  for (const char* text : {"", " ", "1.5x", "1,5", "1 2", "--1", "0x10"}) {
    EXPECT_FALSE(parseDouble(text)) << text;
    EXPECT_FALSE(parseInteger(text)) << text;
  }
  EXPECT_FALSE(parseInteger("1.0"));
}

TEST(ParseNumber, RefusesWhatIsNotFiniteOrDoesNotFit) {
  for (const char* text : {"nan", "inf", "-inf", "1e999"}) EXPECT_FALSE(parseDouble(text)) << text;
  EXPECT_FALSE(parseInteger("9223372036854775808"));
}

}  // namespace
}  // namespace depthmocap

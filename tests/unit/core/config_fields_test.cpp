#include "libtracker/core/config_fields.h"

#include <cmath>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/core/nearest_name.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

TEST(ConfigRange, KnowsItsEnds) {
  EXPECT_TRUE(fromTo(0, 1).contains(0));
  EXPECT_TRUE(fromTo(0, 1).contains(1));
  EXPECT_FALSE(aboveUpTo(0, 1).contains(0));
  EXPECT_TRUE(aboveUpTo(0, 1).contains(1));
  EXPECT_FALSE(between(0, 1).contains(1));
  EXPECT_FALSE(above(2).contains(2));
  EXPECT_TRUE(atLeast(2).contains(2));
  EXPECT_FALSE(fromTo(0, 1).contains(std::nan("")));
  EXPECT_EQ(fromTo(0, 1).text(), "from 0 to 1");
  EXPECT_EQ(aboveUpTo(0, 1).text(), "above 0 and at most 1");
  EXPECT_EQ(atLeast(3).text(), "at least 3");
}

TEST(CheckFields, NamesConfigFieldValueAndRule) {
  double length = -1;
  std::vector<int> counts = {3, 99};
  bool flag = true;
  const std::string wrong_length = errorOf([&] {
    checkFields("Test", {{"flag", &flag, "", kAnyNumber, ""}, {"length_m", &length, "m", above(0), ""}});
  });
  EXPECT_EQ(wrong_length, "Test: length_m must be above 0, not -1");
  EXPECT_EQ(errorOf([&] {
              checkFields("Test", {{"counts", &counts, "", fromTo(1, 50), ""}});
            }),
            "Test: counts must be from 1 to 50, not 99");
}

TEST(NearestName, HasTheFewestEdits) {
  EXPECT_EQ(nearestName("lambda_prio", {"lambda_smooth", "lambda_prior", "sigma_m"}), "lambda_prior");
  EXPECT_EQ(nearestName("", {"abc", "a"}), "a");
}

}  // namespace
}  // namespace depthmocap

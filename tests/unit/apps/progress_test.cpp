#include "apps/terminal/progress.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

TEST(Progress, ShowsShareAndRemainingTime) {
  EXPECT_EQ(progressText(15, 60, 14.0), "[#######.......................]  25 %  0:42 left");
  EXPECT_EQ(progressText(1, 10, 20.0), "[###...........................]  10 %  3:00 left");
}

TEST(Progress, KnowsNoRemainingTimeBeforeTheFirstStep) {
  EXPECT_EQ(progressText(0, 60, 5.0), "[..............................]   0 %");
}

TEST(Progress, IsFullAtTheEndAndBeyond) {
  EXPECT_EQ(progressText(60, 60, 5.0), "[##############################] 100 %  0:00 left");
  EXPECT_EQ(progressText(70, 60, 5.0), progressText(60, 60, 5.0));
}

}  // namespace
}  // namespace depthmocap

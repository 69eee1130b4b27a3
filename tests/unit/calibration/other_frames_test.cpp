#include "calibration/other_frames.h"

#include <vector>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

TEST(OtherFrames, KeepsEveryThirdAndOfTheseTheLast) {
  OtherFrames others;
  for (int i = 0; i < 300; ++i) others.add({i, i / 30.0, {}});
  std::vector<std::int64_t> numbers;
  others([&](const DepthFrame& frame) { numbers.push_back(frame.frame); });
  ASSERT_EQ(numbers.size(), 60U);
  EXPECT_EQ(numbers.front(), 120);
  EXPECT_EQ(numbers.back(), 297);
}

}  // namespace
}  // namespace depthmocap

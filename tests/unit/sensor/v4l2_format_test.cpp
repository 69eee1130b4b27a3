#include "libtracker/sensor/v4l2_format.h"

#include <numeric>
#include <vector>

#include <gtest/gtest.h>
#include <linux/videodev2.h>

namespace depthmocap {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Steps = std::vector<std::uint16_t>;

Steps unpacked(const V4l2Format& format, const Bytes& bytes, bool raw = false) {
  Image<std::uint16_t> steps;
  unpack(format, bytes, raw, steps);
  return steps.data;
}

TEST(V4l2Format, ReadsSixteenBitRowsWithPadding) {
  const V4l2Format format{V4L2_PIX_FMT_Z16, 2, 2, 6};
  EXPECT_EQ(pictureBytes(format), 12U);
  EXPECT_EQ(unpacked(format, {1, 2, 3, 4, 99, 99, 5, 6, 7, 8, 99, 99}), (Steps{0x0201, 0x0403, 0x0605, 0x0807}));
}

TEST(V4l2Format, ReadsTheSecondPlaneOfInfraredAndDepth) {
  // A line is said to have four bytes a pixel, but first come all rows of infrared.
  const V4l2Format format{V4L2_PIX_FMT_INZI, 1, 2, 4};
  EXPECT_EQ(pictureBytes(format), 8U);
  EXPECT_EQ(unpacked(format, {9, 9, 9, 9, 1, 2, 3, 4}), (Steps{0x0201, 0x0403}));
}

TEST(V4l2Format, ReadsTenBitsWithoutGaps) {
  const V4l2Format format{V4L2_PIX_FMT_Y10BPACK, 4, 1, 8};
  EXPECT_EQ(pictureBytes(format), 5U);
  // 0x155, 0x2AA, 0x001, 0x3FF (none), the high bits first
  const Bytes bytes = {0b01010101, 0b01101010, 0b10100000, 0b00000111, 0b11111111};
  EXPECT_EQ(unpacked(format, bytes, true), (Steps{0x155, 0x2AA, 1, 0}));
  EXPECT_EQ(unpacked(format, bytes), (Steps{kinectMillimetres(2 * 0x155), 0, kinectMillimetres(2), 0}))
      << "0x2AA is beyond infinity";
}

TEST(V4l2Format, KnowsTheKinectsDepths) {
  EXPECT_NEAR(kinectMillimetres(600), 705, 2);
  EXPECT_NEAR(kinectMillimetres(800), 1193, 2);
  EXPECT_NEAR(kinectMillimetres(900), 1824, 2);
  EXPECT_NEAR(kinectMillimetres(1000), 3864, 5);
  EXPECT_EQ(kinectMillimetres(2047), 0);
  EXPECT_EQ(kinectMillimetres(1095), 0) << "beyond infinity";
  for (int d = 400; d < 1040; ++d) EXPECT_LE(kinectMillimetres(d), kinectMillimetres(d + 1)) << d;
}

TEST(V4l2Format, NamesFormats) {
  for (const char* name : {"Z16", "Y16", "Y10B", "INZI"}) EXPECT_EQ(fourccName(fourccNamed(name)), name);
  EXPECT_EQ(fourccNamed("Z16"), V4L2_PIX_FMT_Z16);
  EXPECT_EQ(fourccName(V4L2_PIX_FMT_Y16_BE & 0x00FFFFFFU), "Y16?");
}

}  // namespace
}  // namespace depthmocap

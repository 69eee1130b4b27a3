#include "libtracker/sensor/v4l2_driver.h"

#include <gtest/gtest.h>

#include "tests/support/fake_v4l2.h"

namespace depthmocap {
namespace {

TEST(V4l2Driver, NamesDevicesThatMayGiveDepth) {
  FakeV4l2 fake;
  fake.formats = {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_Y16, V4L2_PIX_FMT_Z16};
  const auto found = listV4l2Cameras(fake);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].source, "v4l2:/dev/video7");
  EXPECT_EQ(found[0].name, "Fake depth camera");
  EXPECT_EQ(found[0].formats, "Y16, Z16");
  EXPECT_EQ(fake.open_devices, 0);
}

TEST(V4l2Driver, LeavesOutWebcamsAndDevicesInUse) {
  FakeV4l2 fake;
  fake.formats = {V4L2_PIX_FMT_YUYV};
  EXPECT_TRUE(listV4l2Cameras(fake).empty());
  fake.formats = {V4L2_PIX_FMT_Z16};
  fake.open_error = EBUSY;
  EXPECT_TRUE(listV4l2Cameras(fake).empty());
}

}  // namespace
}  // namespace depthmocap

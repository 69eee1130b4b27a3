#include "libtracker/sensor/usb_cameras.h"

#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

// What the kernel shows of devices, in a folder of ours.
class UsbCameras : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(devices_);
    fs::create_directories(nodes_ / "002");
  }

  void plug(const std::string& name, const std::string& vendor, const std::string& product, const std::string& speed) {
    fs::create_directories(devices_ / name);
    write(devices_ / name / "idVendor", vendor);
    write(devices_ / name / "idProduct", product);
    write(devices_ / name / "busnum", "2");
    write(devices_ / name / "devnum", "7");
    write(devices_ / name / "speed", speed);
    write(nodes_ / "002/007", "");
  }
  void hold(const std::string& interface, const std::string& driver) {
    fs::create_directories(devices_ / interface);
    fs::create_symlink("../../../bus/usb/drivers/" + driver, devices_ / interface / "driver");
  }
  [[nodiscard]] std::vector<UsbCamera> found() const { return findUsbCameras(devices_, nodes_); }

  static void write(const fs::path& path, const std::string& text) { std::ofstream(path) << text << '\n'; }

  TemporaryFolder folder_;
  fs::path devices_ = folder_ / "sys";
  fs::path nodes_ = folder_ / "dev";
};

TEST_F(UsbCameras, NothingPluggedInIsNothingFound) {
  EXPECT_TRUE(found().empty());
  EXPECT_TRUE(findUsbCameras(folder_ / "missing", nodes_).empty());
  plug("2-1", "046d", "c31c", "12");  // a keyboard
  EXPECT_TRUE(found().empty());
}

TEST_F(UsbCameras, AKinectThatTheKernelHolds) {
  plug("2-1", "045e", "02ae", "480");
  hold("2-1:1.0", "gspca_kinect");
  hold("2-10:1.0", "usbhid");  // of another device
  ASSERT_EQ(found().size(), 1U);
  const UsbCamera camera = found().front();
  EXPECT_EQ(camera.name, "Kinect of 2010");
  EXPECT_EQ(camera.id, "045e:02ae");
  EXPECT_EQ(camera.place, "bus 2 device 7");
  EXPECT_EQ(camera.drivers, std::vector<std::string>{"gspca_kinect"});
  ASSERT_EQ(camera.mends.size(), 1U);
  EXPECT_NE(camera.mends[0].find("sudo modprobe -r gspca_kinect"), std::string::npos);
}

TEST_F(UsbCameras, ARealSenseAtAPortThatIsTooSlow) {
  plug("2-2", "8086", "0b07", "480");
  hold("2-2:1.0", "uvcvideo");
  ASSERT_EQ(found().size(), 1U);
  EXPECT_EQ(found()[0].name, "RealSense D435");
  ASSERT_EQ(found()[0].mends.size(), 1U);
  EXPECT_NE(found()[0].mends[0].find("USB 3"), std::string::npos);
  write(devices_ / "2-2/speed", "5000");
  EXPECT_TRUE(found()[0].mends.empty());
}

TEST_F(UsbCameras, ACameraThatYouMayNotWriteTo) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write to everything";
  plug("2-3", "2bc5", "0401", "480");
  chmod((nodes_ / "002/007").c_str(), 0444);
  ASSERT_EQ(found()[0].mends.size(), 1U);
  EXPECT_NE(found()[0].mends[0].find("ATTR{idVendor}==\"2bc5\""), std::string::npos) << found()[0].mends[0];
}

TEST_F(UsbCameras, AFamilyIsNamedByWhatTheCameraSays) {
  plug("2-4", "2bc5", "066b", "5000");
  write(devices_ / "2-4/product", "Femto Bolt");
  EXPECT_EQ(found()[0].name, "Orbbec (Femto Bolt)");
  EXPECT_TRUE(found()[0].mends.empty());
}

TEST_F(UsbCameras, FilesThatSayNothingAreNoCamera) {
  fs::create_directories(devices_ / "2-5");
  write(devices_ / "2-5/idVendor", std::string(100000, '0'));
  EXPECT_TRUE(found().empty());
}

}  // namespace
}  // namespace depthmocap

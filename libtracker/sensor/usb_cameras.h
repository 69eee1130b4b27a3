#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace depthmocap {

// A depth camera that is plugged in, by what the kernel says of its USB device: found whether or not anything can open
// it.
struct UsbCamera {
  std::string name;                  // as people call it
  std::string id;                    // vendor:product
  std::string place;                 // of the device: bus and number
  std::vector<std::string> drivers;  // of the kernel, that hold its interfaces
  std::string use;                   // how to track with it
  std::vector<std::string> mends;    // what keeps it from working, each with the line that helps; empty: nothing known
};

// All that are plugged in. The folders are the kernel's; others for tests.
std::vector<UsbCamera> findUsbCameras(const std::filesystem::path& devices = "/sys/bus/usb/devices",
                                      const std::filesystem::path& nodes = "/dev/bus/usb");

}  // namespace depthmocap

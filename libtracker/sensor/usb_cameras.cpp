#include "libtracker/sensor/usb_cameras.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr double kSuperSpeed = 5000;  // [Mbit/s] of USB 3

// What a family of cameras needs.
struct Kind {
  const char* use;
  const char* driver_in_the_way;  // of the kernel; null: none
  bool needs_usb3;
};
constexpr Kind kOpenNi{"--source openni2", nullptr, false};
constexpr Kind kKinect1{"--source openni2 with libfreenect's driver for OpenNI2, or --source v4l2:/dev/videoN",
                        "gspca_kinect", false};
constexpr Kind kKinect2{"python3 kinect2.py | depthmocap live --source pipe:-", nullptr, true};
constexpr Kind kAzure{"python3 azure_kinect.py | depthmocap live --source pipe:-", nullptr, true};
constexpr Kind kOrbbec{"python3 orbbec.py | depthmocap live --source pipe:-, older ones --source openni2", nullptr,
                       false};
constexpr Kind kRealSense{"python3 realsense.py | depthmocap live --source pipe:-, or --source v4l2:/dev/videoN",
                          nullptr, true};

struct Known {
  std::string_view vendor;
  std::string_view product;  // "": all of the vendor's
  const char* name;
  const Kind* kind;
};
constexpr std::array kKnown = {
    Known{"045e", "02ae", "Kinect of 2010", &kKinect1},
    Known{"045e", "02bf", "Kinect for Windows of 2012", &kKinect1},
    Known{"045e", "02c4", "Kinect of 2013", &kKinect2},
    Known{"045e", "02d8", "Kinect of 2013", &kKinect2},
    Known{"045e", "097c", "Azure Kinect", &kAzure},
    Known{"1d27", "", "PrimeSense, Asus Xtion or Structure", &kOpenNi},
    Known{"2bc5", "", "Orbbec", &kOrbbec},
    Known{"8086", "0aa5", "RealSense SR300", &kRealSense},
    Known{"8086", "0b48", "RealSense SR305", &kRealSense},
    Known{"8086", "0ad1", "RealSense D400", &kRealSense},
    Known{"8086", "0ad2", "RealSense D410", &kRealSense},
    Known{"8086", "0ad3", "RealSense D415", &kRealSense},
    Known{"8086", "0ad4", "RealSense D430", &kRealSense},
    Known{"8086", "0ad5", "RealSense D450", &kRealSense},
    Known{"8086", "0b07", "RealSense D435", &kRealSense},
    Known{"8086", "0b3a", "RealSense D435i", &kRealSense},
    Known{"8086", "0b5b", "RealSense D405", &kRealSense},
    Known{"8086", "0b5c", "RealSense D455", &kRealSense},
    Known{"8086", "0b64", "RealSense L515", &kRealSense},
};

// The one line of a file of the kernel; empty where it cannot be read.
std::string lineOf(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

const Known* knownDevice(const std::string& vendor, const std::string& product) {
  const auto* found = std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& known) {
    return known.vendor == vendor && (known.product.empty() || known.product == product);
  });
  return found != kKnown.end() ? found : nullptr;
}

// Of the interfaces of a device, which lie beside it under its name and a colon.
std::vector<std::string> driversOf(const fs::path& device) {
  std::vector<std::string> drivers;
  std::error_code ignored;
  const std::string prefix = device.filename().string() + ":";
  for (const auto& entry : fs::directory_iterator(device.parent_path(), ignored)) {
    if (!entry.path().filename().string().starts_with(prefix)) continue;
    const fs::path driver = fs::read_symlink(entry.path() / "driver", ignored);
    if (driver.empty()) continue;
    const std::string name = driver.filename().string();
    if (std::find(drivers.begin(), drivers.end(), name) == drivers.end()) drivers.push_back(name);
  }
  std::sort(drivers.begin(), drivers.end());
  return drivers;
}

int numberIn(const fs::path& path) {
  return std::atoi(lineOf(path).c_str());
}

std::vector<std::string> mendsOf(const fs::path& device, const fs::path& node, const Kind& kind,
                                 const UsbCamera& camera) {
  std::vector<std::string> mends;
  const auto in_the_way = [&](const std::string& driver) {
    return kind.driver_in_the_way != nullptr && driver == kind.driver_in_the_way;
  };
  if (std::any_of(camera.drivers.begin(), camera.drivers.end(), in_the_way)) {
    mends.push_back(
        fmt::format("the kernel's {0} holds it, so that OpenNI2 cannot: sudo modprobe -r {0}", kind.driver_in_the_way));
  }
  std::error_code ignored;  // libraries of cameras open the device's file
  if (fs::exists(node, ignored) && access(node.c_str(), W_OK) != 0) {
    mends.push_back(
        fmt::format("you may not write to {}: echo 'SUBSYSTEM==\"usb\", ATTR{{idVendor}}==\"{}\", MODE=\"0666\"' | "
                    "sudo tee /etc/udev/rules.d/60-depthmocap.rules, then plug it in anew",
                    node.string(), camera.id.substr(0, camera.id.find(':'))));
  }
  const double speed = std::atof(lineOf(device / "speed").c_str());
  if (kind.needs_usb3 && speed > 0 && speed < kSuperSpeed) {
    mends.push_back(fmt::format("it runs at {:g} Mbit/s, USB 2: take a port and a cable of USB 3", speed));
  }
  return mends;
}

}  // namespace

std::vector<UsbCamera> findUsbCameras(const fs::path& devices, const fs::path& nodes) {
  std::vector<UsbCamera> cameras;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(devices, ignored)) {
    const fs::path& device = entry.path();
    const std::string vendor = lineOf(device / "idVendor");
    const std::string product = lineOf(device / "idProduct");
    const Known* known = knownDevice(vendor, product);
    if (known == nullptr) continue;
    UsbCamera camera;
    const std::string told = lineOf(device / "product");
    camera.name = known->product.empty() && !told.empty() ? fmt::format("{} ({})", known->name, told) : known->name;
    camera.id = fmt::format("{}:{}", vendor, product);
    const int bus = numberIn(device / "busnum");
    const int number = numberIn(device / "devnum");
    camera.place = fmt::format("bus {} device {}", bus, number);
    camera.drivers = driversOf(device);
    camera.use = known->kind->use;
    camera.mends =
        mendsOf(device, nodes / fmt::format("{:03}", bus) / fmt::format("{:03}", number), *known->kind, camera);
    cameras.push_back(std::move(camera));
  }
  std::sort(cameras.begin(), cameras.end(), [](const UsbCamera& a, const UsbCamera& b) { return a.place < b.place; });
  return cameras;
}

}  // namespace depthmocap

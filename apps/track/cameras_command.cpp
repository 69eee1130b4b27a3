#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/commands.h"
#include "depthmocap/error.h"
#include "libtracker/sensor/driver_table.h"
#include "libtracker/sensor/usb_cameras.h"

namespace depthmocap {
namespace {

void listCameras() {
  const DriverTable& drivers = cameraDrivers();
  const std::vector<FoundCamera> cameras = drivers.list();
  if (cameras.empty()) {
    throw Error("no camera found", drivers.listedTitles(),
                "depthmocap cameras --check says what is plugged in and what it lacks; more in docs/guide/cameras.md");
  }
  for (const FoundCamera& camera : cameras) {
    std::cout << camera.source << "  " << camera.name;
    if (!camera.formats.empty()) std::cout << " (" << camera.formats << ")";
    std::cout << '\n';
  }
}

// What is plugged in, and what keeps it from working.
void checkCameras() {
  const std::vector<UsbCamera> plugged = findUsbCameras();
  std::size_t to_mend = 0;
  for (const UsbCamera& camera : plugged) {
    std::cout << camera.name << ", USB " << camera.id << ", " << camera.place << '\n';
    std::cout << "  kernel driver: "
              << (camera.drivers.empty() ? "none" : fmt::format("{}", fmt::join(camera.drivers, ", "))) << '\n';
    for (const std::string& mend : camera.mends) std::cout << "  to mend: " << mend << '\n';
    std::cout << "  use: " << camera.use << '\n';
    to_mend += camera.mends.size();
  }
  const std::vector<FoundCamera> cameras = cameraDrivers().list();
  for (const FoundCamera& camera : cameras) std::cout << "ready: " << camera.source << "  " << camera.name << '\n';
  std::cout.flush();
  if (plugged.empty() && cameras.empty()) {
    throw Error("no depth camera is plugged in", "USB", "lsusb must show it: try another cable, port or power supply");
  }
  if (to_mend > 0) throw Error(fmt::format("there is something to mend ({})", to_mend), "cameras");
}

}  // namespace

void addCamerasCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("cameras", "Lists the depth cameras that are there, as names for --source.");
  const auto check = std::make_shared<bool>(false);
  command->add_flag("--check", *check,
                    "Says what is plugged in, which driver of the kernel holds it, what right is missing, and the line "
                    "that mends it");
  command->footer("Example:\n  depthmocap cameras --check");
  command->callback([check] { *check ? checkCameras() : listCameras(); });
}

}  // namespace depthmocap

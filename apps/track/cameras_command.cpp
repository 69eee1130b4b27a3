#include <CLI/CLI.hpp>
#include <iostream>

#include "apps/commands.h"
#include "depthmocap/error.h"
#include "libtracker/sensor/driver_table.h"

namespace depthmocap {
namespace {

void listCameras() {
  const DriverTable& drivers = cameraDrivers();
  const std::vector<FoundCamera> cameras = drivers.list();
  if (cameras.empty()) {
    throw Error("no camera found", drivers.listedTitles(),
                "docs/guide/cameras.md says what to check: cable and power, rights, kernel drivers, the OpenNI2 "
                "drivers folder");
  }
  for (const FoundCamera& camera : cameras) {
    std::cout << camera.source << "  " << camera.name;
    if (!camera.formats.empty()) std::cout << " (" << camera.formats << ")";
    std::cout << '\n';
  }
}

}  // namespace

void addCamerasCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("cameras", "Lists the depth cameras that are there, as names for --source.");
  command->callback([] { listCameras(); });
}

}  // namespace depthmocap

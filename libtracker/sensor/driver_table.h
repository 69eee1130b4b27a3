#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "libtracker/sensor/camera_driver.h"

namespace depthmocap {

// Finds the driver of a source by its name, and speaks for all drivers together.
class DriverTable {
 public:
  explicit DriverTable(std::vector<CameraDriver> drivers) : drivers_(std::move(drivers)) {}

  [[nodiscard]] const std::vector<CameraDriver>& drivers() const { return drivers_; }
  // "" where the name can be a source's, else what is wrong with it.
  [[nodiscard]] std::string check(const std::string& name) const;
  // Error for a name that check() refuses, and as the driver's open().
  [[nodiscard]] std::unique_ptr<DepthSource> open(const std::string& name, const SourceOptions& options) const;
  // The cameras of all drivers, in the table's order.
  [[nodiscard]] std::vector<FoundCamera> list() const;
  // The forms of names that there are, with the drivers' remarks: "openni2, openni2:URI, or replay:REC (a recording)".
  [[nodiscard]] std::string help() const;
  // The titles of the drivers that list cameras: "OpenNI2 and V4L2".
  [[nodiscard]] std::string listedTitles() const;

 private:
  [[nodiscard]] const CameraDriver* find(std::string_view prefix) const;

  std::vector<CameraDriver> drivers_;
};

// The drivers of this build. The table itself: drivers.cpp.
const DriverTable& cameraDrivers();

}  // namespace depthmocap

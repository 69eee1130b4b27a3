#include "libtracker/sensor/driver_table.h"

#include <optional>

#include "depthmocap/error.h"

namespace depthmocap {

namespace {

struct SourceName {
  std::string_view prefix;
  std::optional<std::string_view> address;  // none: there is no colon
};

SourceName split(std::string_view name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos) return {name, std::nullopt};
  return {name.substr(0, colon), name.substr(colon + 1)};
}

// "a, b, <last>c".
std::string joined(const std::vector<std::string>& texts, std::string_view separator, std::string_view last) {
  std::string all;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (i > 0) all += i + 1 == texts.size() ? last : separator;
    all += texts[i];
  }
  return all;
}

}  // namespace

const CameraDriver* DriverTable::find(std::string_view prefix) const {
  for (const CameraDriver& driver : drivers_) {
    if (driver.prefix == prefix) return &driver;
  }
  return nullptr;
}

std::string DriverTable::check(const std::string& name) const {
  const auto [prefix, address] = split(name);
  if (const CameraDriver* driver = find(prefix)) return driver->check(address);
  std::vector<std::string> names;
  for (const CameraDriver& driver : drivers_) names.insert(names.end(), driver.names.begin(), driver.names.end());
  return "'" + name + "' is no source; sources are " + joined(names, ", ", ", ");
}

std::unique_ptr<DepthSource> DriverTable::open(const std::string& name, const SourceOptions& options) const {
  const std::string wrong = check(name);
  if (!wrong.empty()) throw Error(wrong, "--source");
  const auto [prefix, address] = split(name);
  return find(prefix)->open(std::string(address.value_or("")), options);
}

std::vector<FoundCamera> DriverTable::list() const {
  std::vector<FoundCamera> all;
  for (const CameraDriver& driver : drivers_) {
    if (driver.list == nullptr) continue;
    for (FoundCamera& camera : driver.list()) all.push_back(std::move(camera));
  }
  return all;
}

std::string DriverTable::help() const {
  std::vector<std::string> names;
  for (const CameraDriver& driver : drivers_) {
    names.insert(names.end(), driver.names.begin(), driver.names.end());
    if (!driver.remark.empty()) names.back() += " (" + std::string(driver.remark) + ")";
  }
  return joined(names, ", ", ", or ");
}

std::string DriverTable::listedTitles() const {
  std::vector<std::string> titles;
  for (const CameraDriver& driver : drivers_) {
    if (driver.list != nullptr) titles.emplace_back(driver.title);
  }
  return joined(titles, ", ", " and ");
}

}  // namespace depthmocap

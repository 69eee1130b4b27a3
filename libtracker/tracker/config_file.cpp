#include "libtracker/tracker/config_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/json_file.h"
#include "libtracker/core/nearest_name.h"

namespace depthmocap {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr const char* kFormat = "depthmocap-config";
constexpr int kVersion = 1;

ordered_json toJson(const ConfigField& field) {
  return std::visit(
      [](const auto& value) -> ordered_json {
        if constexpr (std::is_pointer_v<std::decay_t<decltype(value)>>) {
          return *value;
        } else {
          return std::vector<double>(value.begin(), value.end());
        }
      },
      field.value);
}

// One value of a file into one field.
struct Assign {
  const json& given;
  const std::string& where;  // file, section and field

  [[noreturn]] void refuse(const char* what) const { throw Error(fmt::format("must be {}", what), where); }
  void operator()(double* value) const {
    if (!given.is_number() || !std::isfinite(given.get<double>())) refuse("a number");
    *value = given.get<double>();
  }
  void operator()(int* value) const {
    if (!given.is_number_integer() || std::abs(given.get<double>()) > 1e9) refuse("a whole number");
    *value = given.get<int>();
  }
  void operator()(bool* value) const {
    if (!given.is_boolean()) refuse("true or false");
    *value = given.get<bool>();
  }
  void operator()(std::vector<int>* values) const {
    if (!given.is_array() || given.size() > 64) refuse("a list of at most 64 whole numbers");
    values->assign(given.size(), 0);
    for (std::size_t i = 0; i < given.size(); ++i) Assign{given[i], where}(&(*values)[i]);
  }
  void operator()(std::span<double> values) const {
    if (!given.is_array() || given.size() != values.size()) {
      refuse(fmt::format("a list of {} numbers", values.size()).c_str());
    }
    for (std::size_t i = 0; i < given.size(); ++i) Assign{given[i], where}(&values[i]);
  }
};

template <typename Items>
std::string unknown(const std::string& name, const Items& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const auto& item : items) names.emplace_back(item.name);
  return fmt::format("there is no \"{}\"; did you mean \"{}\"?", name, nearestName(name, names));
}

template <typename Items>
auto* find(Items& items, const std::string& name) {
  const auto found = std::find_if(items.begin(), items.end(), [&](const auto& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

}  // namespace

void readConfigFile(const std::filesystem::path& path, TrackerConfig& config) {
  const std::string where = path.string();
  const json file = readJsonFile(path);
  checkJsonFormat(file, kFormat, kVersion, where);
  std::vector<TrackerConfig::Section> sections = config.sections();
  for (const auto& [section_name, given] : file.items()) {
    if (section_name == "format" || section_name == "version") continue;
    TrackerConfig::Section* section = find(sections, section_name);
    if (section == nullptr) throw Error(unknown(section_name, sections), where);
    const std::string at = fmt::format("{}: {}", where, section_name);
    if (!given.is_object()) throw Error("must be an object", at);
    for (const auto& [name, value] : given.items()) {
      ConfigField* field = find(section->fields, name);
      if (field == nullptr) throw Error(unknown(name, section->fields), at);
      const std::string field_at = fmt::format("{}.{}", at, name);
      std::visit(Assign{value, field_at}, field->value);
    }
  }
  try {
    config.validate();
  } catch (const Error& error) {
    throw Error(error.what(), where);
  }
}

void writeConfigFile(const std::filesystem::path& path, const TrackerConfig& config) {
  TrackerConfig copy = config;
  ordered_json file = {{"format", kFormat}, {"version", kVersion}};
  for (const TrackerConfig::Section& section : copy.sections()) {
    for (const ConfigField& field : section.fields) file[section.name][field.name] = toJson(field);
  }
  writeFileAtomically(path, file.dump(2) + "\n");
}

std::string configTable() {
  TrackerConfig defaults;
  std::string table;
  for (const TrackerConfig::Section& section : defaults.sections()) {
    table +=
        fmt::format("\n## {}\n\n| field | default | unit | range | meaning |\n|---|---|---|---|---|\n", section.name);
    for (const ConfigField& field : section.fields) {
      const bool is_switch = std::holds_alternative<bool*>(field.value);
      table += fmt::format("| `{}` | {} | {} | {} | {} |\n", field.name, toJson(field).dump(), field.unit,
                           is_switch ? "true or false" : field.range.text(), field.help);
    }
  }
  return table;
}

}  // namespace depthmocap

#include "libtracker/core/config_fields.h"

#include <cmath>

#include <fmt/format.h>

#include "depthmocap/error.h"

namespace depthmocap {

void checkConfig(bool holds, std::string_view config, std::string_view field, double value, std::string_view rule) {
  if (!holds) throw Error(fmt::format("{} must be {}, not {}", field, rule, value), std::string(config));
}

bool ConfigRange::contains(double value) const {
  const bool above_low = low_open ? value > low : value >= low;  // false for NaN
  return above_low && (high_open ? value < high : value <= high);
}

std::string ConfigRange::text() const {
  const bool has_low = std::isfinite(low);
  const bool has_high = std::isfinite(high);
  if (!has_low && !has_high) return "any number";
  if (has_low && has_high && !low_open && !high_open) return fmt::format("from {} to {}", low, high);
  const std::string from = has_low ? fmt::format("{} {}", low_open ? "above" : "at least", low) : "";
  const std::string to = has_high ? fmt::format("{} {}", high_open ? "below" : "at most", high) : "";
  return from + (has_low && has_high ? " and " : "") + to;
}

namespace {

struct Check {
  std::string_view config;
  const ConfigField& field;
  void one(double value) const {
    checkConfig(field.range.contains(value), config, field.name, value, field.range.text());
  }
  void operator()(const double* value) const { one(*value); }
  void operator()(const int* value) const { one(*value); }
  void operator()(const bool*) const {}
  void operator()(const std::vector<int>* values) const {
    for (const int value : *values) one(value);
  }
  void operator()(std::span<double> values) const {
    for (const double value : values) one(value);
  }
};

}  // namespace

void checkFields(std::string_view config, const std::vector<ConfigField>& fields) {
  for (const ConfigField& field : fields) std::visit(Check{config, field}, field.value);
}

}  // namespace depthmocap

#pragma once
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace depthmocap {

// Throws Error naming config, field, value and rule where the rule does not hold. `rule` completes "it must be ...".
void checkConfig(bool holds, std::string_view config, std::string_view field, double value, std::string_view rule);

// The values that a field may take.
struct ConfigRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;   // low itself is not allowed
  bool high_open = false;  // likewise

  [[nodiscard]] bool contains(double value) const;
  [[nodiscard]] std::string text() const;  // "above 0", "from 0 to 1"
};
inline constexpr ConfigRange kAnyNumber{};
constexpr ConfigRange above(double low) {
  return {.low = low, .low_open = true};
}
constexpr ConfigRange atLeast(double low) {
  return {.low = low};
}
constexpr ConfigRange fromTo(double low, double high) {
  return {.low = low, .high = high};
}
constexpr ConfigRange aboveUpTo(double low, double high) {
  return {.low = low, .high = high, .low_open = true};
}
constexpr ConfigRange between(double low, double high) {
  return {.low = low, .high = high, .low_open = true, .high_open = true};
}

// One field of a configuration: the list of them drives checks, files and the reference page. A config gives its list
// by `std::vector<ConfigField> fields()`; the pointers are to its own members.
struct ConfigField {
  // A list's every value must lie in the range.
  using Value = std::variant<double*, int*, bool*, std::vector<int>*, std::span<double>>;
  std::string_view name;
  Value value;
  std::string_view unit;  // "m", "rad", "frames"; empty: a number
  ConfigRange range;
  std::string_view help;  // one sentence without a full stop
};

// Every field within its range.
void checkFields(std::string_view config, const std::vector<ConfigField>& fields);

// checkFields of a constant config.
template <typename Config>
void checkFieldsOf(std::string_view name, const Config& config) {
  Config copy = config;
  checkFields(name, copy.fields());
}

}  // namespace depthmocap

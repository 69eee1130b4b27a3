#include "apps/learn/other_option.h"

#include <array>
#include <optional>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/parse_number.h"

namespace depthmocap {
namespace {

constexpr std::string_view kForm = "write MOTION[,KEY=VALUE...]";
constexpr double kMostFrames = 1e9;

struct Key {
  std::string_view name;
  double least;
  double most;
};
constexpr std::array<Key, 6> kKeys = {{{"distance", 0.3, 10.0},
                                       {"yaw", -360.0, 360.0},
                                       {"aside", -10.0, 10.0},
                                       {"height", 1.0, 2.2},
                                       {"weight", 10.0, 160.0},
                                       {"first", 0.0, kMostFrames}}};

double numberOf(std::string_view name, std::string_view value) {
  for (const Key& key : kKeys) {
    if (key.name != name) continue;
    const std::optional<double> number = parseDouble(value);
    if (number && *number >= key.least && *number <= key.most) return *number;
    throw Error(fmt::format("'{}' is '{}'", name, value), "--other",
                fmt::format("a number from {} to {}", key.least, key.most));
  }
  throw Error(fmt::format("there is no '{}'", name), "--other",
              "distance, yaw, aside, height, weight, sex and first are there");
}

// Whether the weight was given.
bool set(OtherOption& option, std::string_view name, std::string_view value) {
  if (name == "sex") {
    if (value != "m" && value != "f") throw Error(fmt::format("'sex' is '{}'", value), "--other", "m or f");
    option.shape.sex = value == "f" ? Sex::Female : Sex::Male;
    return false;
  }
  const double number = numberOf(name, value);
  if (name == "distance") option.distance_m = number;
  if (name == "yaw") option.yaw_deg = number;
  if (name == "aside") option.aside_m = number;
  if (name == "height") option.shape.stature_m = number;
  if (name == "weight") option.shape.weight_kg = number;
  if (name == "first") option.first = static_cast<std::int64_t>(number);
  return name == "weight";
}

}  // namespace

OtherOption parseOther(std::string_view text) {
  OtherOption option;
  std::size_t at = text.find(',');
  option.motion = text.substr(0, at);
  if (option.motion.empty()) throw Error("names no motion", "--other", std::string(kForm));
  bool weighed = false;
  while (at != std::string_view::npos) {
    const std::size_t end = text.find(',', at + 1);
    const std::string_view pair = text.substr(at + 1, end == std::string_view::npos ? end : end - at - 1);
    const std::size_t equals = pair.find('=');
    if (equals == std::string_view::npos)
      throw Error(fmt::format("'{}' has no value", pair), "--other", std::string(kForm));
    if (set(option, pair.substr(0, equals), pair.substr(equals + 1))) weighed = true;
    at = end;
  }
  if (!weighed) option.shape.weight_kg = kAverageBodyMassIndex * option.shape.stature_m * option.shape.stature_m;
  return option;
}

}  // namespace depthmocap

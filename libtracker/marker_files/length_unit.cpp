#include "libtracker/marker_files/length_unit.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/parse_number.h"

namespace depthmocap {

double metresPerUnit(std::string_view name, const std::string& where) {
  struct Unit {
    std::string_view name;
    double metres;
  };
  static constexpr std::array<Unit, 10> kUnits = {{{"mm", 0.001},
                                                   {"millimeters", 0.001},
                                                   {"cm", 0.01},
                                                   {"centimeters", 0.01},
                                                   {"dm", 0.1},
                                                   {"m", 1.0},
                                                   {"meters", 1.0},
                                                   {"in", 0.0254},
                                                   {"inches", 0.0254},
                                                   {"ft", 0.3048}}};
  std::string lower(trimmed(name));
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const Unit& unit : kUnits) {
    if (lower == unit.name) return unit.metres;
  }
  throw Error(fmt::format("has the unknown unit of length '{}'", lower.substr(0, 20)), where, "mm, cm, m or in");
}

}  // namespace depthmocap

#include "apps/terminal/correction_options.h"

#include <CLI/CLI.hpp>
#include <string>

#include <fmt/format.h>

#include "libtracker/core/parse_number.h"

namespace depthmocap {
namespace {

constexpr double kFinestUnit_mm = 1000 * kFinestUnit_m;
constexpr double kCoarsestUnit_mm = 1000 * kCoarsestUnit_m;

std::string checkUnit(const std::string& text) {
  const std::optional<double> unit_mm = parseDouble(text);  // no number: also nan
  if (unit_mm && *unit_mm >= kFinestUnit_mm && *unit_mm <= kCoarsestUnit_mm) return "";
  return fmt::format("'{}' is no number from {} to {}", text, kFinestUnit_mm, kCoarsestUnit_mm);
}

}  // namespace

RecordingCorrection CorrectionChoice::read() const {
  CameraCorrection correction{camera_file, std::nullopt, turn_deg};
  if (depth_unit_mm) correction.depth_unit_m = *depth_unit_mm / 1000.0;
  return readCorrection(correction);
}

void addCorrectionOptions(CLI::App& command, CorrectionChoice& choice) {
  command
      .add_option("--camera", choice.camera_file,
                  "Intrinsics, distortion and depth unit of the camera, as in a recording.json (default: what the "
                  "recording or the camera says, or those usual for its picture size)")
      ->type_name("C.json")
      ->check(CLI::ExistingFile);
  command
      .add_option("--depth-unit", choice.depth_unit_mm,
                  "Millimetres a depth step (default: what the recording says, or by the camera's pixel format)")
      ->type_name("MM")
      ->check(checkUnit);
  command
      .add_option("--turn", choice.turn_deg,
                  "A camera on its side or upside down: degrees clockwise that make its pictures upright")
      ->type_name("DEG")
      ->check(CLI::IsMember({0, 90, 180, 270}))
      ->capture_default_str();
}

}  // namespace depthmocap

#include "apps/terminal/correction_options.h"

#include <CLI/CLI.hpp>
#include <string>

#include <fmt/format.h>

#include "libtracker/core/parse_number.h"
#include "libtracker/recording/recording_header.h"

namespace depthmocap {
namespace {

// [mm] Depth steps of cameras are 0.1, 0.125, 0.2, 0.25, 1 and 10 mm; farther out it is a mistake.
constexpr double kFinestUnit_mm = 0.001;
constexpr double kCoarsestUnit_mm = 100;

std::string checkUnit(const std::string& text) {
  const std::optional<double> unit_mm = parseDouble(text);  // no number: also nan
  if (unit_mm && *unit_mm >= kFinestUnit_mm && *unit_mm <= kCoarsestUnit_mm) return "";
  return fmt::format("'{}' is no number from {} to {}", text, kFinestUnit_mm, kCoarsestUnit_mm);
}

}  // namespace

RecordingCorrection CorrectionChoice::read() const {
  RecordingCorrection correction;
  if (!camera_file.empty()) correction.camera = readRecordingHeader(camera_file);
  if (depth_unit_mm) correction.depth_unit_m = *depth_unit_mm / 1000.0;
  correction.turn_deg = turn_deg;
  return correction;
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

#include "libtracker/sensor/open_source.h"

#include <string_view>

#include "libtracker/core/config_fields.h"
#include "libtracker/core/parse_number.h"
#include "libtracker/sensor/driver_table.h"
#include "libtracker/sensor/turned_source.h"

namespace depthmocap {

namespace {
constexpr int kLargestSide = 16384;       // [px] of a picture, as of a recording
constexpr double kFastestCamera = 10000;  // [1/s] likewise
}  // namespace

std::string checkSourceName(const std::string& name) {
  return cameraDrivers().check(name);
}

void SourceOptions::validate() const {
  const char* config = "SourceOptions";
  checkConfig(speed >= 0 && speed <= kFastestReplay, config, "speed", speed, "from 0 to 1000");
  if (mode) {
    checkConfig(mode->width >= 1 && mode->width <= kLargestSide, config, "mode.width", mode->width, "from 1 to 16384");
    checkConfig(mode->height >= 1 && mode->height <= kLargestSide, config, "mode.height", mode->height,
                "from 1 to 16384");
    checkConfig(mode->fps >= 0 && mode->fps <= kFastestCamera, config, "mode.fps", mode->fps, "from 0 to 10000");
  }
  RecordingCorrection{camera, depth_unit_m, turn_deg}.validate();
}

std::unique_ptr<DepthSource> openSource(const std::string& name, const SourceOptions& options) {
  options.validate();
  return turnedSource(cameraDrivers().open(name, options), options.turn_deg);
}

std::optional<DepthMode> parseDepthMode(const std::string& text) {
  const std::string_view all = text;
  const std::size_t cross = all.find('x');
  const std::size_t at = all.find('@');
  if (cross == std::string_view::npos) return std::nullopt;
  const auto width = parseInteger(all.substr(0, cross));
  const auto height = parseInteger(all.substr(cross + 1, at == std::string_view::npos ? at : at - cross - 1));
  const auto fps = at == std::string_view::npos ? 0.0 : parseDouble(all.substr(at + 1));
  if (!width || !height || !fps || *width < 1 || *height < 1 || *width > kLargestSide || *height > kLargestSide ||
      *fps < 0 || *fps > kFastestCamera) {
    return std::nullopt;
  }
  return DepthMode{static_cast<int>(*width), static_cast<int>(*height), *fps};
}

}  // namespace depthmocap

#include "libtracker/sensor/open_source.h"

#include <string_view>

#include "libtracker/core/parse_number.h"
#include "libtracker/sensor/driver_table.h"
#include "libtracker/sensor/turned_source.h"

namespace depthmocap {

std::string checkSourceName(const std::string& name) {
  return cameraDrivers().check(name);
}

std::unique_ptr<DepthSource> openSource(const std::string& name, const SourceOptions& options) {
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
  if (!width || !height || !fps || *width < 1 || *height < 1 || *width > 16384 || *height > 16384 || *fps < 0) {
    return std::nullopt;
  }
  return DepthMode{static_cast<int>(*width), static_cast<int>(*height), *fps};
}

}  // namespace depthmocap

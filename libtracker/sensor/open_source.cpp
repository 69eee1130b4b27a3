#include "libtracker/sensor/open_source.h"

#include <string_view>

#include "depthmocap/error.h"
#include "libtracker/core/parse_number.h"
#include "libtracker/sensor/replay_source.h"
#include "libtracker/sensor/returning_source.h"
#include "libtracker/sensor/v4l2_source.h"
#ifdef DEPTHMOCAP_OPENNI2
#include "libtracker/openni/openni_runtime.h"
#include "libtracker/sensor/openni_source.h"
#endif

namespace depthmocap {

namespace {

struct SourceName {
  std::string_view kind;
  std::string_view rest;  // after the colon
};

SourceName split(std::string_view name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos) return {name, {}};
  return {name.substr(0, colon), name.substr(colon + 1)};
}

#ifdef DEPTHMOCAP_OPENNI2
// Holds the runtime while the camera is away: the runtime hears when it comes back.
std::unique_ptr<DepthSource> openReturningOpenNi(const std::string& uri, const SourceOptions& options) {
  return std::make_unique<ReturningSource>(
      [uri, options, runtime = OpenNiRuntime::start()] { return openOpenNiCamera(uri, options); });
}
#else
std::unique_ptr<DepthSource> openReturningOpenNi(const std::string&, const SourceOptions&) {
  throw Error("this build has no OpenNI2", "openni2", "configure it with -DDEPTHMOCAP_OPENNI2=ON");
}
#endif

}  // namespace

std::string checkSourceName(const std::string& name) {
  const auto [kind, rest] = split(name);
  if (kind == "replay") return rest.empty() ? "replay needs a recording: replay:REC" : "";
  if (kind == "openni2") return name == "openni2:" ? "openni2: needs a URI, or no colon" : "";
  if (kind == "v4l2") return rest.empty() ? "v4l2 needs a device: v4l2:/dev/video0" : "";
  return "'" + name + "' is no source; sources are openni2, openni2:URI, v4l2:/dev/videoN, replay:REC";
}

std::unique_ptr<DepthSource> openSource(const std::string& name, const SourceOptions& options) {
  const std::string wrong = checkSourceName(name);
  if (!wrong.empty()) throw Error(wrong, "--source");
  const auto [kind, rest] = split(name);
  if (kind == "openni2") return openReturningOpenNi(std::string(rest), options);
  if (kind == "v4l2") {
    return std::make_unique<ReturningSource>(
        [path = std::string(rest), options] { return openV4l2Camera(path, options); });
  }
  return std::make_unique<ReplaySource>(openRecording(rest), options.speed);
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

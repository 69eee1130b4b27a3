#pragma once
#include <memory>
#include <optional>
#include <string>

#include "depthmocap/camera.h"
#include "libtracker/sensor/depth_source.h"

namespace depthmocap {

inline constexpr double kFastestReplay = 1000;  // times a recording's own pace; no tracker keeps up with so much

// What one may say about a source beyond its name.
struct SourceOptions {
  double speed = 1;                     // (0 .. kFastestReplay) of a replay; 0 = as fast as frames are asked for
  std::optional<DepthMode> mode;        // none: 640x480 at 30 per second, or what comes nearest
  std::optional<RecordingInfo> camera;  // intrinsics, distortion and depth unit; none: what the camera says itself
  std::string pixel_format;             // V4L2 fourcc; empty: the best one that the camera offers
  std::optional<double> depth_unit_m;   // [m] a depth step; none: by the pixel format, or as recorded
  int turn_deg = 0;       // (0, 90, 180, 270) clockwise, that makes the pictures of a camera on its side upright
  void validate() const;  // throws Error naming field, value and rule
};

// Names are those of the drivers (driver_table.h). Error for another name, a camera that is not there or cannot be
// used, a recording that cannot be read. Cameras come back after they were unplugged.
std::unique_ptr<DepthSource> openSource(const std::string& name, const SourceOptions& options);

// "" where the name can be a source's, else what is wrong with it.
std::string checkSourceName(const std::string& name);

// `640x480@30` or `640x480`; nothing where the text is no mode.
std::optional<DepthMode> parseDepthMode(const std::string& text);

}  // namespace depthmocap

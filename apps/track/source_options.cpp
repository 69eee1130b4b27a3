#include "apps/track/source_options.h"

#include <CLI/CLI.hpp>

#include "libtracker/recording/recording_header.h"

namespace depthmocap {

void addSourceOptions(CLI::App& command, SourceChoice& c) {
  command
      .add_option("--source", c.source,
                  "openni2, openni2:URI, v4l2:/dev/videoN, or replay:REC (a recording as if it were a camera)")
      ->type_name("SRC")
      ->check([](const std::string& name) { return checkSourceName(name); })
      ->required();
  command.add_option("--seconds", c.seconds, "Stop after so many seconds (default: go on until Ctrl-C)")
      ->check(CLI::PositiveNumber);
  command.add_option("--mode", c.mode, "Picture size and rate to ask the camera for, like 640x480@30")
      ->type_name("WxH[@FPS]")
      ->check([](const std::string& text) { return parseDepthMode(text) ? "" : "must be like 640x480@30 or 640x480"; });
  command
      .add_option("--camera", c.camera_file,
                  "Intrinsics, distortion and depth unit of the camera, as in a recording.json (default: what the "
                  "camera says, or those usual for its picture size)")
      ->type_name("C.json")
      ->check(CLI::ExistingFile);
  command.add_option("--pixel-format", c.pixel_format, "V4L2: the fourcc to use, one of Z16, Y16, Y10B, INZI")
      ->check(CLI::IsMember({"Z16", "Y16", "Y10B", "INZI"}));
  command.add_option("--depth-unit", c.depth_unit_mm, "V4L2: millimetres a depth step (default: by the pixel format)")
      ->check(CLI::Range(0.001, 100.0));
  command
      .add_option("--speed", c.speed,
                  "Pace of replay: 1 as recorded, 2 twice as fast; 0 as fast as it goes, dropping nothing")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
}

std::unique_ptr<DepthSource> openChosenSource(const SourceChoice& choice) {
  SourceOptions options;
  options.speed = choice.speed;
  if (!choice.mode.empty()) options.mode = parseDepthMode(choice.mode);
  if (!choice.camera_file.empty()) options.camera = readRecordingHeader(choice.camera_file);
  options.pixel_format = choice.pixel_format;
  if (choice.depth_unit_mm > 0) options.depth_unit_m = choice.depth_unit_mm / 1000.0;
  return openSource(choice.source, options);
}

}  // namespace depthmocap

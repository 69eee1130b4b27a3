#include "apps/track/source_options.h"

#include <CLI/CLI.hpp>

#include "apps/terminal/warnings.h"
#include "libtracker/sensor/driver_table.h"

namespace depthmocap {

namespace {

void addDriverOption(CLI::App& command, const DriverOption& option, SourceOptions& target) {
  const auto set = option.set;
  command
      .add_option_function<std::string>(
          std::string(option.flag), [set, &target](const std::string& text) { set(text, target); }, option.help)
      ->type_name(std::string(option.value))
      ->default_str(std::string(option.preset))
      ->check([set](const std::string& text) {
        SourceOptions unused;
        return set(text, unused);
      });
}

}  // namespace

CLI::Option* addSourceOptions(CLI::App& command, SourceChoice& c) {
  CLI::Option* source = command.add_option("--source", c.source, cameraDrivers().help())
                            ->type_name("SRC")
                            ->check([](const std::string& name) { return checkSourceName(name); })
                            ->required();
  command.add_option("--seconds", c.seconds, "Stop after so many seconds (default: go on until Ctrl-C)")
      ->check(CLI::PositiveNumber);
  command.add_option("--mode", c.mode, "Picture size and rate to ask the camera for, like 640x480@30")
      ->type_name("WxH[@FPS]")
      ->check([](const std::string& text) { return parseDepthMode(text) ? "" : "must be like 640x480@30 or 640x480"; });
  addCorrectionOptions(command, c.correction);
  for (const CameraDriver& driver : cameraDrivers().drivers()) {
    for (const DriverOption& option : driver.options) addDriverOption(command, option, c.of_driver);
  }
  return source;
}

std::unique_ptr<DepthSource> openChosenSource(const SourceChoice& choice) {
  SourceOptions options = choice.of_driver;
  if (!choice.mode.empty()) options.mode = parseDepthMode(choice.mode);
  const RecordingCorrection correction = choice.correction.read();
  options.camera = correction.camera;
  options.depth_unit_m = correction.depth_unit_m;
  options.turn_deg = correction.turn_deg;
  std::unique_ptr<DepthSource> source = openSource(choice.source, options);
  warn(source->info().guesses);
  return source;
}

}  // namespace depthmocap

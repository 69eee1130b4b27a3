#pragma once
#include <string>

#include "apps/terminal/correction_options.h"
#include "libtracker/sensor/open_source.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace depthmocap {

// Options of every command that reads a camera.
struct SourceChoice {
  std::string source;
  std::string mode;
  CorrectionChoice correction;
  SourceOptions of_driver;  // what the drivers' own options have set
  double seconds = 0;       // 0 = until the source ends or Ctrl-C
};

// Returns the option --source, which must be given unless the command says otherwise.
CLI::Option* addSourceOptions(CLI::App& command, SourceChoice& choice);

// Opens the source that was chosen; Error as openSource.
std::unique_ptr<DepthSource> openChosenSource(const SourceChoice& choice);

}  // namespace depthmocap

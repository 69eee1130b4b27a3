#pragma once
#include <filesystem>
#include <string>

#include "libtracker/sensor/open_source.h"

namespace CLI {
class App;
}

namespace depthmocap {

// Options of every command that reads a camera.
struct SourceChoice {
  std::string source;
  std::string mode;
  std::filesystem::path camera_file;
  SourceOptions of_driver;  // what the drivers' own options have set
  double seconds = 0;       // 0 = until the source ends or Ctrl-C
};

void addSourceOptions(CLI::App& command, SourceChoice& choice);

// Opens the source that was chosen; Error as openSource.
std::unique_ptr<DepthSource> openChosenSource(const SourceChoice& choice);

}  // namespace depthmocap

#pragma once
#include <filesystem>
#include <optional>

#include "libtracker/recording/recording.h"

namespace CLI {
class App;
}

namespace depthmocap {

// What somebody knows better than a camera or a recording: options of every command that reads pictures.
struct CorrectionChoice {
  std::filesystem::path camera_file;
  std::optional<double> depth_unit_mm;
  int turn_deg = 0;

  // Reads the camera's file; Error where it cannot be read.
  [[nodiscard]] RecordingCorrection read() const;
};

// --camera, --depth-unit and --turn.
void addCorrectionOptions(CLI::App& command, CorrectionChoice& choice);

}  // namespace depthmocap

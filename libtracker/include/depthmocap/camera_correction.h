#pragma once
#include <filesystem>
#include <optional>

namespace depthmocap {

// What you know better than a recording or a camera; the options --camera, --depth-unit and --turn of the program.
struct CameraCorrection {
  // Intrinsics, distortion and depth unit, in the form of a recording.json, for pictures of the size that they have;
  // empty: what the recording or the camera says, or what is usual for its pictures.
  std::filesystem::path camera_file{};
  std::optional<double>
      depth_unit_m{};  // [m] (1e-6 .. 0.1) per depth step, before all else; none: as said or by the format
  int turn_deg = 0;    // (0, 90, 180, 270) clockwise, that makes the pictures of a camera on its side upright
};

}  // namespace depthmocap

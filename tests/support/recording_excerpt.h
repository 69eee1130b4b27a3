#pragma once
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace depthmocap {

inline std::filesystem::path bundledRecording(const std::string& name) {
  return std::filesystem::path(DEPTHMOCAP_SOURCE_DIR) / "recordings" / name;
}

inline std::string framePng(int frame) {
  char name[32];
  std::snprintf(name, sizeof name, "%06d.png", frame);
  return name;
}

// Copies the first frames of a bundled recording to a folder, where a test may damage them.
inline void copyExcerpt(const std::string& name, int frames, const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  fs::create_directories(folder / "depth");
  fs::copy_file(bundledRecording(name) / "recording.json", folder / "recording.json");
  std::ofstream index(folder / "frames.csv");
  index << "frame,time_s,file\n";
  for (int frame = 0; frame < frames; ++frame) {
    const std::string file = "depth/" + framePng(frame);
    index << frame << ',' << frame / 30.0 << ',' << file << '\n';
    fs::copy_file(bundledRecording(name) / file, folder / file);
  }
}

}  // namespace depthmocap

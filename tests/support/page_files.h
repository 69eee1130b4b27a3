#pragma once
#include <filesystem>

#include "tests/support/temporary_folder.h"

namespace depthmocap {

// Stand-ins for all files that LivePage asks of a page's folder.
inline void makePageFiles(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  const std::filesystem::path page = std::filesystem::path(DEPTHMOCAP_SOURCE_DIR) / "apps/view/page";
  for (const auto& file : std::filesystem::directory_iterator(page)) writeBytes(folder / file.path().filename(), "x");
  for (const char* file : {"three.min.js", "OrbitControls.js", "GLTFLoader.js"}) writeBytes(folder / file, "x");
}

}  // namespace depthmocap

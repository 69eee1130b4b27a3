#pragma once
#include <cstdlib>
#include <filesystem>

namespace depthmocap {

// The optional MakeHuman files; tests skip where they are not.
inline std::filesystem::path makeHumanFolder() {
  const char* data = std::getenv("DEPTHMOCAP_DATA");
  const std::filesystem::path root = data != nullptr ? data : DEPTHMOCAP_SOURCE_DIR "/../shared/data";
  return root / "bodies" / "makehuman";
}

}  // namespace depthmocap

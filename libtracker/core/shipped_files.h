#pragma once
#include <filesystem>

namespace depthmocap {

// Files that come with the build or the installation: the default forests and pose database. Looked for in
// $DEPTHMOCAP_SHARE, then beside the program in share/depthmocap (build tree), then in ../share/depthmocap (installed).
// Throws Error naming the file and where it was looked for.
std::filesystem::path shippedFile(const std::string& name);

}  // namespace depthmocap

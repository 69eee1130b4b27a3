#pragma once
#include <filesystem>

namespace depthmocap {

// Files that come with the library: forests, pose database, learned poses. Looked for in $DEPTHMOCAP_SHARE, then in
// share/depthmocap in the folder of this code (the program or the shared library) and in the two folders above it, so
// that an installed prefix can be moved, then likewise from the program's folder. Throws Error naming the file and
// where it was looked for.
std::filesystem::path shippedFile(const std::string& name);

// Where the program that runs lies; empty where the system does not tell.
std::filesystem::path programFolder();

}  // namespace depthmocap

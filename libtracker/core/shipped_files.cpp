#include "libtracker/core/shipped_files.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <link.h>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

// The folder of the shared library that holds this function; empty where the program itself holds it.
fs::path libraryFolder() {
  Dl_info info{};
  void* entry = nullptr;
  if (dladdr1(reinterpret_cast<void*>(&libraryFolder), &info, &entry, RTLD_DL_LINKMAP) == 0 || entry == nullptr) {
    return {};
  }
  const fs::path library = static_cast<const link_map*>(entry)->l_name;  // "" of the program
  std::error_code ignored;
  return library.empty() ? fs::path{} : fs::canonical(library, ignored).parent_path();
}

// share/depthmocap in this folder (build tree), in the one above (an installed lib or bin), and in the one above that
// (lib/x86_64-linux-gnu).
void addFoldersNear(const fs::path& folder, std::vector<fs::path>& folders) {
  if (folder.empty()) return;
  for (const fs::path& base : {folder, folder.parent_path(), folder.parent_path().parent_path()}) {
    const fs::path share = base / "share" / "depthmocap";
    if (std::find(folders.begin(), folders.end(), share) == folders.end()) folders.push_back(share);
  }
}

}  // namespace

fs::path programFolder() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

fs::path shippedFile(const std::string& name) {
  std::vector<fs::path> folders;
  if (const char* share = std::getenv("DEPTHMOCAP_SHARE")) folders.emplace_back(share);
  addFoldersNear(libraryFolder(), folders);
  addFoldersNear(programFolder(), folders);
  std::error_code ignored;
  std::string tried;
  for (const fs::path& folder : folders) {
    if (fs::exists(folder / name, ignored)) return folder / name;
    tried += (tried.empty() ? "" : ", ") + folder.string();
  }
  throw Error("a file that comes with the library is missing; looked in " + tried, name,
              "build the target 'all', or set DEPTHMOCAP_SHARE to its folder");
}

}  // namespace depthmocap

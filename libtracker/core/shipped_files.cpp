#include "libtracker/core/shipped_files.h"

#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "depthmocap/error.h"

namespace depthmocap {

std::filesystem::path shippedFile(const std::string& name) {
  std::vector<std::filesystem::path> folders;
  if (const char* share = std::getenv("DEPTHMOCAP_SHARE")) folders.emplace_back(share);
  std::error_code ignored;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  folders.push_back(program / "share" / "depthmocap");
  folders.push_back(program.parent_path() / "share" / "depthmocap");
  std::string tried;
  for (const auto& folder : folders) {
    if (std::filesystem::exists(folder / name, ignored)) return folder / name;
    tried += (tried.empty() ? "" : ", ") + folder.string();
  }
  throw Error("a file that comes with the build is missing; looked in " + tried, name,
              "build the target 'all' or set DEPTHMOCAP_SHARE");
}

}  // namespace depthmocap

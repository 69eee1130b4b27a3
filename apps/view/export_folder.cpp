#include "apps/view/export_folder.h"

#include <algorithm>
#include <cstdlib>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kLeastSpace = std::uintmax_t{1}
                                       << 30U;  // [bytes] left free; the longest recording's files take less
constexpr std::size_t kLongestName = 80;        // [bytes] what no file system refuses

bool isPlain(char c) {
  const auto lower = static_cast<char>(c | 0x20);
  return (c >= '0' && c <= '9') || (lower >= 'a' && lower <= 'z') || c == '.' || c == '_' || c == '-';
}

// Of a recording's name, which may be anything that a folder can be called.
std::string plainName(const std::string& name) {
  std::string plain = name.substr(0, kLongestName);
  std::ranges::replace_if(
      plain, [](char c) { return !isPlain(c); }, '_');
  if (plain.empty() || plain.front() == '.') plain.insert(0, "recording");
  return plain;
}

}  // namespace

ExportFolder::ExportFolder(const std::string& recording) : name_(plainName(recording)) {
  std::error_code unknown;
  const fs::path temporary = fs::temp_directory_path(unknown);
  const fs::space_info space = fs::space(temporary, unknown);
  if (!unknown && space.available < kLeastSpace) {
    throw Error("the disk is nearly full", temporary.string(), "free some space, or set TMPDIR to another folder");
  }
  std::string pattern = (temporary / "depthmocap-XXXXXX").string();
  if (mkdtemp(pattern.data()) == nullptr) throw Error("no folder can be made for the files", temporary.string());
  path_ = pattern;
}

ExportFolder::~ExportFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<ExportFile> ExportFolder::list(const std::vector<ExportFormat>& formats) const {
  std::vector<ExportFile> files;
  for (const ExportFormat& format : formats) {
    const std::size_t before = files.size();
    for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
      const std::string name = entry.path().filename().string();
      if (name.ends_with(format.ending)) files.push_back({format.name, name, entry.file_size()});
    }
    std::ranges::sort(files.begin() + static_cast<std::ptrdiff_t>(before), files.end(), {}, &ExportFile::name);
  }
  return files;
}

}  // namespace depthmocap

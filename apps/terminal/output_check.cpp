#include "apps/terminal/output_check.h"

#include <array>
#include <optional>
#include <string_view>
#include <system_error>

#include <sys/stat.h>

#include "depthmocap/error.h"
#include "libtracker/core/pending_file.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

using FileId = std::pair<std::uint64_t, std::uint64_t>;

// The same for all names and links of a file; nothing where there is none.
std::optional<FileId> idOf(const fs::path& path) {
  struct stat found = {};
  if (stat(path.c_str(), &found) != 0) return std::nullopt;
  return FileId{found.st_dev, found.st_ino};
}

bool isSame(const fs::path& a, const fs::path& b) {
  if (const auto id = idOf(a)) return id == idOf(b);
  std::error_code failure;
  const auto whole = [&](const fs::path& path) {
    return fs::weakly_canonical(fs::absolute(linkTarget(path)), failure);
  };
  return whole(a) == whole(b) && !failure;
}

// Devices and pipes take what several write.
bool isSpecial(const fs::path& path) {
  std::error_code failure;
  return fs::exists(path, failure) && fs::is_other(path, failure);
}

// What a recording's folder consists of: lists, pictures and the folders that hold them.
std::vector<fs::path> contentOf(const fs::path& recording) {
  constexpr std::array<std::string_view, 9> kNames = {"recording.json", "frames.csv",   "depth",
                                                      "truth",          "truth/labels", "truth/joints.csv",
                                                      "truth/pose.csv", "depth.txt",    "associations.txt"};
  std::vector<fs::path> content = {recording};
  for (const std::string_view name : kNames) content.push_back(recording / name);
  std::set<fs::path> folders;
  try {
    const auto files = openRecording(recording)->files();
    content.insert(content.end(), files.begin(), files.end());
    for (const fs::path& file : files) folders.insert(file.parent_path());
  } catch (const Error&) {  // NOLINT(bugprone-empty-catch): reading it will say so
  }
  content.insert(content.end(), folders.begin(), folders.end());
  return content;
}

}  // namespace

void OutputCheck::reads(const fs::path& file) {
  if (const auto id = idOf(file)) inputs_.insert(*id);
}

void OutputCheck::readsRecording(const std::string& recording_or_source) {
  constexpr std::string_view kReplay = "replay:";
  const bool is_replay = recording_or_source.starts_with(kReplay);
  const fs::path recording = is_replay ? recording_or_source.substr(kReplay.size()) : recording_or_source;
  std::error_code failure;
  if (!fs::is_directory(recording, failure)) return reads(recording);
  for (const fs::path& part : contentOf(recording)) reads(part);
}

void OutputCheck::writes(const std::string& option, const fs::path& file) {
  if (file.empty()) return;
  add(option, file);
  const PendingFile probe(file);
}

void OutputCheck::writesFolder(const std::string& option, const fs::path& folder) {
  if (folder.empty()) return;
  add(option, folder);
  std::error_code failure;
  if (fs::exists(folder, failure) && !fs::is_directory(folder, failure)) {
    throw Error("is a file, not a folder", folder.string(), "name a folder for " + option);
  }
}

void OutputCheck::add(const std::string& option, const fs::path& path) {
  if (isSpecial(path)) return;
  const auto id = idOf(path);
  if (id && inputs_.contains(*id)) {
    throw Error("is read, and " + option + " would overwrite it", path.string(), "name another");
  }
  for (const Output& other : outputs_) {
    if (!isSame(path, other.path)) continue;
    throw Error("is named by " + other.option + " and by " + option, path.string(), "name two files");
  }
  outputs_.push_back({option, path});
}

}  // namespace depthmocap

#include "apps/view/recording_shelf.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "depthmocap/error.h"
#include "libtracker/core/shipped_files.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr int kMostEntries = 10000;  // of a folder that are looked at: more would hold up whoever asks
constexpr int kMostFiles = 200000;   // of a recording that are counted: an hour and a half at 30 per second

// Where the recordings that come with the program are; nothing where they were left out.
std::optional<fs::path> bundledFolder() {
  try {
    return shippedFile("recordings");
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::uintmax_t bytesOf(const fs::path& path) {
  std::error_code failure;
  if (!fs::is_directory(path, failure)) return fs::file_size(path, failure);
  std::uintmax_t bytes = 0;
  int files = 0;
  fs::recursive_directory_iterator entry(path, failure);
  for (; !failure && entry != fs::end(entry) && files < kMostFiles; entry.increment(failure), ++files) {
    std::error_code unknown;
    const std::uintmax_t size = entry->is_regular_file(unknown) ? entry->file_size(unknown) : 0;
    if (!unknown) bytes += size;
  }
  return bytes;
}

// Unix time [s] of the newest of its files that say what it holds; 0 where there is none.
double modifiedSeconds(const fs::path& path) {
  double newest_s = 0;
  for (const fs::path& file : {path, path / "recording.json", path / "frames.csv", path / "depth.txt"}) {
    std::error_code missing;
    const fs::file_time_type time = fs::last_write_time(file, missing);
    if (missing) continue;
    const std::chrono::duration<double> since = fs::file_time_type::clock::to_sys(time).time_since_epoch();
    newest_s = std::max(newest_s, since.count());
  }
  return newest_s;
}

void readInto(ShelvedRecording& shelved) {
  try {
    const auto reader = openRecording(shelved.recording.path, shelved.recording.correction);
    shelved.frames = reader->frameCount();
    shelved.duration_s = reader->time(shelved.frames - 1) - reader->time(0);
    shelved.width = reader->info().camera.width;
    shelved.height = reader->info().camera.height;
  } catch (const std::exception& error) {
    shelved.problem = error.what();
  }
}

fs::path named(const fs::path& path) {
  const fs::path plain = fs::absolute(path).lexically_normal();
  return plain.has_filename() ? plain : plain.parent_path();
}

}  // namespace

RecordingShelf::RecordingShelf(fs::path folder, std::optional<NamedRecording> of_command)
    : folder_(std::move(folder)), of_command_(std::move(of_command)) {}

std::vector<ShelvedRecording> RecordingShelf::list() {
  const std::lock_guard lock(*mutex_);
  std::vector<ShelvedRecording> all;
  if (of_command_) all.push_back(describe("command", *of_command_));
  addFolder("folder", folder_, all);
  if (const auto bundled = bundledFolder()) addFolder("bundled", *bundled, all);
  return all;
}

std::optional<ShelvedRecording> RecordingShelf::find(const std::string& id) {
  for (ShelvedRecording& shelved : list()) {
    if (shelved.id == id) return std::move(shelved);
  }
  return std::nullopt;
}

void RecordingShelf::addFolder(const std::string& place, const fs::path& folder, std::vector<ShelvedRecording>& all) {
  std::vector<std::pair<double, fs::path>> found;
  std::error_code failure;
  int looked_at = 0;
  fs::directory_iterator entry(folder, failure);
  for (; !failure && entry != fs::end(entry) && looked_at < kMostEntries; entry.increment(failure), ++looked_at) {
    std::error_code unknown;
    const bool linked = entry->is_symlink(unknown);  // may lead out of the folder
    if (!linked && !unknown && looksLikeRecording(entry->path())) {
      found.emplace_back(-modifiedSeconds(entry->path()), entry->path());
    }
  }
  std::ranges::sort(found);
  if (found.size() > kMost) found.resize(kMost);
  for (const auto& [age, path] : found) all.push_back(describe(place, {path, {}}));
}

ShelvedRecording RecordingShelf::describe(const std::string& place, const NamedRecording& recording) {
  ShelvedRecording shelved;
  shelved.name = named(recording.path).filename().string();
  shelved.id = place + "/" + shelved.name;
  shelved.recording = recording;
  shelved.modified_s = modifiedSeconds(recording.path);
  const auto known = known_.find(shelved.id);
  if (known != known_.end() && known->second.modified_s == shelved.modified_s) return known->second;
  readInto(shelved);
  shelved.bytes = bytesOf(recording.path);
  known_.insert_or_assign(shelved.id, shelved);
  return shelved;
}

}  // namespace depthmocap

#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "apps/view/recording_tracker.h"

namespace depthmocap {

// A recording that the page offers.
struct ShelvedRecording {
  std::string id;    // what the page calls it by: "folder/take-001"; never a path
  std::string name;  // of its folder or file
  NamedRecording recording;
  std::string problem;  // why it cannot be opened; else empty, and
  std::size_t frames = 0;
  double duration_s = 0;
  std::uintmax_t bytes = 0;  // of its files
  double modified_s = 0;     // Unix time at which it changed last
  int width = 0;             // [px] of its pictures
  int height = 0;
};

// The recordings that the page offers: the one of the command, those in the folder of the page, and those that come
// with the program. Looked for anew at each call; what a recording holds is read again where it has changed. Any
// thread.
class RecordingShelf {
 public:
  // Nothing is there of what does not exist.
  explicit RecordingShelf(std::filesystem::path folder, std::optional<NamedRecording> of_command = {});

  // The newest first, of each place; at most kMost of the folder.
  [[nodiscard]] std::vector<ShelvedRecording> list();
  // The one that list() gave this id. Names are compared with what is there; no path is made of them.
  [[nodiscard]] std::optional<ShelvedRecording> find(const std::string& id);

  static constexpr std::size_t kMost = 200;

 private:
  void addFolder(const std::string& place, const std::filesystem::path& folder, std::vector<ShelvedRecording>& all);
  ShelvedRecording describe(const std::string& place, const NamedRecording& recording);

  std::filesystem::path folder_;
  std::optional<NamedRecording> of_command_;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
  std::map<std::string, ShelvedRecording> known_;  // by id
};

}  // namespace depthmocap

#pragma once
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace depthmocap {

// What a command reads and will write, checked before it begins to work: each output can be written, none is an input
// or part of one, and no two are the same file. Paths that are empty are options that were not given.
class OutputCheck {
 public:
  void reads(const std::filesystem::path& file);
  // A recording, or the name of a camera, of which only `replay:REC` is a place of files.
  void readsRecording(const std::string& recording_or_source);
  // `option` names the output in errors: "--joints". Throws Error where the file cannot be written or is taken.
  void writes(const std::string& option, const std::filesystem::path& file);
  // A folder that is made, or gets files of its own.
  void writesFolder(const std::string& option, const std::filesystem::path& folder);

 private:
  struct Output {
    std::string option;
    std::filesystem::path path;
  };
  void add(const std::string& option, const std::filesystem::path& path);

  std::set<std::pair<std::uint64_t, std::uint64_t>> inputs_;  // device and number of each file or folder
  std::vector<Output> outputs_;
};

}  // namespace depthmocap

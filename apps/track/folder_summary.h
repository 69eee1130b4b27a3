#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace depthmocap {

// What became of one recording of a folder.
struct FolderEntry {
  std::string name;           // of the recording, relative to the folder
  std::filesystem::path out;  // its results
  std::string status;         // "tracked", "done before", "failed", "stopped"
};

// Reads the results of every entry and writes a row each: frames, figures of the run, movements found, and the range of
// each clinical angle [deg]. Fields of recordings without results are empty.
void writeFolderSummary(const std::filesystem::path& path, const std::vector<FolderEntry>& entries);

// The same in short, for people.
std::string folderTable(const std::vector<FolderEntry>& entries);

}  // namespace depthmocap

#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/view/recording_tracker.h"

namespace depthmocap {

// A file that can be had.
struct ExportFile {
  std::string format;  // name of the format
  std::string name;
  std::uintmax_t bytes = 0;
};

// A folder of its own for the files of one recording, among the system's temporary ones; only its user may look into
// it. It goes with the object.
class ExportFolder {
 public:
  // Error where the disk is nearly full or the folder cannot be made. `recording`: what the files are named by.
  explicit ExportFolder(const std::string& recording);
  ~ExportFolder();
  ExportFolder(const ExportFolder&) = delete;
  ExportFolder& operator=(const ExportFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // Of the files, without ending: letters, digits and ._- only, so that it stands in an address as it is.
  [[nodiscard]] const std::string& name() const { return name_; }
  // The files that are there, in the order of the formats.
  [[nodiscard]] std::vector<ExportFile> list(const std::vector<ExportFormat>& formats) const;

 private:
  std::filesystem::path path_;
  std::string name_;
};

}  // namespace depthmocap

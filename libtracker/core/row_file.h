#pragma once
#include <filesystem>
#include <string_view>

#include "libtracker/core/atomic_file.h"

namespace depthmocap {

// A table on its way to a file: kept whenever it holds whole rows, even when the work was broken off.
class RowFile {
 public:
  RowFile(const std::filesystem::path& path, std::string_view head);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  void write(std::string_view row);
  void finish();

 private:
  AtomicFile file_;
  bool worth_keeping_ = false;
};

}  // namespace depthmocap

#include "libtracker/core/row_file.h"

#include <exception>

namespace depthmocap {

RowFile::RowFile(const std::filesystem::path& path, std::string_view head) : file_(path) {
  file_.write(head);
}

RowFile::~RowFile() {
  if (!worth_keeping_) return;
  try {
    file_.commit();
  } catch (const std::exception&) {  // NOLINT(bugprone-empty-catch): another failure is already being reported
  }
}

void RowFile::write(std::string_view row) {
  worth_keeping_ = false;  // a row that fails halfway (disk full) spoils the file
  file_.write(row);
  worth_keeping_ = true;
}

void RowFile::finish() {
  worth_keeping_ = false;
  file_.commit();
}

}  // namespace depthmocap

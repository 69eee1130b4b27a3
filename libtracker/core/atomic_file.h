#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string_view>

#include "libtracker/core/pending_file.h"

namespace depthmocap {

// A file that appears whole or not at all: bytes go to a PendingFile, which commit() renames into place. Every failure
// throws Error naming the path and the system's reason (no such folder, disk full).
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);

  void write(std::string_view bytes);
  void commit(Sync sync = Sync::AtOnce);  // once, after the last write

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  PendingFile pending_;
  std::unique_ptr<std::FILE, Close> file_;
};

// The whole content of a file at once.
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes, Sync sync = Sync::AtOnce);

}  // namespace depthmocap

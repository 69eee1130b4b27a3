#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace depthmocap {

// A file that appears whole or not at all: bytes go to a temporary file beside `path`, commit() renames it into place.
// A path that is no regular file (/dev/stdout, a pipe) is written directly. Every failure throws Error naming the path
// and the system's reason (no such folder, disk full).
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();  // without commit(): nothing appears at `path`
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(std::string_view bytes);
  void commit();  // once, after the last write

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  void openTemporary();
  [[noreturn]] void fail() const;

  std::filesystem::path path_;       // as the caller named it, for messages
  std::filesystem::path target_;     // with symbolic links followed
  std::filesystem::path temporary_;  // empty: `target_` is written directly
  std::unique_ptr<std::FILE, Close> file_;
};

// The whole content of a file at once.
void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes);

}  // namespace depthmocap

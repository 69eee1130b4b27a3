#pragma once
#include <filesystem>
#include <string>

namespace depthmocap {

// How a finished file gets to the disk: at once, or with the folder that it belongs to (syncFolder()), which of many
// small files is much faster.
enum class Sync { AtOnce, WithFolder };

// The file that a path stands for when symbolic links are followed; it may not exist yet. Empty where it is an open
// file of a process (/dev/stdout is a link to /proc/self/fd/1), which a new file of the same name would not reach.
std::filesystem::path linkTarget(std::filesystem::path path);

// Where a file is written until it is whole: a new, empty file beside `path` of a name that nothing had, renamed into
// place by commit(). Symbolic links are followed and stay. What is no regular file (/dev/null, a FIFO, /dev/stdout,
// whatever that is connected to) is never replaced: it is written directly. Every failure throws Error naming the path
// and the system's reason.
class PendingFile {
 public:
  // `ending` of the temporary name, for writers that go by it (".mp4").
  explicit PendingFile(std::filesystem::path path, const std::string& ending = {});
  ~PendingFile();  // without commit(): nothing appears at `path`
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  // Where to write.
  [[nodiscard]] const std::filesystem::path& writtenTo() const { return isDirect() ? path_ : temporary_; }
  [[nodiscard]] bool isDirect() const { return temporary_.empty(); }
  void commit(Sync sync = Sync::AtOnce);
  // Throws Error for the system's last failure (errno).
  [[noreturn]] void fail() const;

 private:
  std::filesystem::path path_;       // as the caller named it
  std::filesystem::path target_;     // with symbolic links followed
  std::filesystem::path temporary_;  // empty: `path_` is written directly, or all is done
};

// Brings all that was written into a folder to the disk.
void syncFolder(const std::filesystem::path& folder);

}  // namespace depthmocap

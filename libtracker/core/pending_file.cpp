#include "libtracker/core/pending_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {

// Tries of a free temporary name: another writer, or a process that was killed, may hold some.
constexpr int kTemporaryNames = 1000;
constexpr int kMostLinks = 40;  // symbolic links to follow, as many as Linux does

// Opens and syncs; a file system that cannot do so is passed over.
bool synced(const fs::path& path, int flags, int (*sync)(int)) {
  const int file = open(path.c_str(), flags | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = sync(file) == 0 || errno == EINVAL || errno == ENOSYS;
  const int reason = errno;
  close(file);
  errno = reason;
  return done;
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

}  // namespace

fs::path linkTarget(fs::path path) {
  std::error_code unused;
  for (int i = 0; i < kMostLinks && fs::is_symlink(path, unused); ++i) {
    const fs::path folder = fs::absolute(path, unused).parent_path();
    if (fs::weakly_canonical(folder, unused).native().starts_with("/proc/")) return {};
    path = folder / fs::read_symlink(path, unused);
  }
  return path;
}

PendingFile::PendingFile(fs::path path, const std::string& ending)
    : path_(std::move(path)), target_(linkTarget(path_)) {
  std::error_code unused;
  const fs::file_type type = fs::status(path_, unused).type();
  if (type == fs::file_type::directory) throw Error("is a folder, not a file", path_.string(), "name a file");
  if (target_.empty() || (type != fs::file_type::not_found && type != fs::file_type::regular)) return;
  if (type == fs::file_type::regular && access(target_.c_str(), W_OK) != 0) fail();
  for (int i = 0; i < kTemporaryNames; ++i) {
    fs::path name = target_;
    name += ".tmp" + std::to_string(i) + ending;
    const int file = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) {
      close(file);
      temporary_ = name;
      return;
    }
    if (errno != EEXIST) break;
  }
  fail();
}

PendingFile::~PendingFile() {
  std::error_code unused;
  if (!temporary_.empty()) fs::remove(temporary_, unused);
}

void PendingFile::commit(Sync sync) {
  if (isDirect()) return;
  if (sync == Sync::AtOnce && !synced(temporary_, O_WRONLY, fsync)) fail();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail();
  temporary_.clear();
  if (sync == Sync::AtOnce) (void)synced(folderOf(target_), O_RDONLY | O_DIRECTORY, fsync);
}

void PendingFile::fail() const {
  const int reason = errno;
  const char* advice = "";
  if (reason == ENOENT) advice = "create its folder first";
  if (reason == ENOSPC || reason == EDQUOT) advice = "free some space";
  if (reason == EACCES || reason == EROFS) advice = "choose a folder that you may write to";
  throw Error(std::string("cannot be written: ") + std::strerror(reason), path_.string(), advice);
}

void syncFolder(const fs::path& folder) {
  if (synced(folder, O_RDONLY | O_DIRECTORY, syncfs)) return;
  throw Error(std::string("cannot be brought to the disk: ") + std::strerror(errno), folder.string());
}

}  // namespace depthmocap

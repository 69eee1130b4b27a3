#include "libtracker/core/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {
// Tries of a free temporary name: another writer, or a process that was killed, may hold some.
constexpr int kTemporaryNames = 1000;
}  // namespace

AtomicFile::AtomicFile(const fs::path& path) : path_(path), target_(path) {
  std::error_code unused;
  if (fs::is_symlink(path, unused)) target_ = fs::weakly_canonical(path, unused);
  const fs::file_type type = fs::status(target_, unused).type();
  if (type == fs::file_type::directory) throw Error("is a folder, not a file", path.string(), "name a file");
  if (type == fs::file_type::not_found || type == fs::file_type::regular) {
    openTemporary();
  } else {
    file_.reset(std::fopen(target_.c_str(), "wb"));
  }
  if (!file_) fail();
}

AtomicFile::~AtomicFile() {
  file_.reset();
  std::error_code unused;
  if (!temporary_.empty()) fs::remove(temporary_, unused);
}

void AtomicFile::openTemporary() {
  for (int i = 0; i < kTemporaryNames && !file_; ++i) {
    fs::path name = target_;
    name += ".tmp" + std::to_string(i);
    file_.reset(std::fopen(name.c_str(), "wbx"));
    if (file_) temporary_ = name;
    if (!file_ && errno != EEXIST) return;
  }
}

void AtomicFile::write(std::string_view bytes) {
  DMC_CHECK(file_ != nullptr);
  if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail();
}

void AtomicFile::commit() {
  DMC_CHECK(file_ != nullptr);
  if (std::fclose(file_.release()) != 0) fail();
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail();
  temporary_.clear();
}

void AtomicFile::fail() const {
  const int reason = errno;
  const char* advice = "";
  if (reason == ENOENT) advice = "create its folder first";
  if (reason == ENOSPC || reason == EDQUOT) advice = "free some space";
  if (reason == EACCES || reason == EROFS) advice = "choose a folder that you may write to";
  throw Error(std::string("cannot be written: ") + std::strerror(reason), path_.string(), advice);
}

void writeFileAtomically(const fs::path& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace depthmocap

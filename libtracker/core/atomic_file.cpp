#include "libtracker/core/atomic_file.h"

#include "libtracker/core/check.h"

namespace depthmocap {

AtomicFile::AtomicFile(const std::filesystem::path& path)
    : pending_(path), file_(std::fopen(pending_.writtenTo().c_str(), "wbe")) {
  if (!file_) pending_.fail();
}

void AtomicFile::write(std::string_view bytes) {
  DMC_CHECK(file_ != nullptr);
  if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) pending_.fail();
}

void AtomicFile::commit(Sync sync) {
  DMC_CHECK(file_ != nullptr);
  if (std::fclose(file_.release()) != 0) pending_.fail();
  pending_.commit(sync);
}

void writeFileAtomically(const std::filesystem::path& path, std::string_view bytes, Sync sync) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit(sync);
}

}  // namespace depthmocap

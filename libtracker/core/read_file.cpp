#include "libtracker/core/read_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <system_error>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

constexpr std::size_t kStep = mebibytes(1);  // read at a time, where the system does not tell the size
// Of a device or a pipe, which may never end: several times the largest file that comes with the program.
constexpr std::size_t kMostUnknown = mebibytes(128);

struct Close {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

std::string readFile(const std::filesystem::path& path, const std::string& what, std::size_t most_bytes) {
  const auto fail = [&](const std::string& why) {
    throw Error("cannot read " + what + ": " + why, path.string(), "is it the right file?");
  };
  const auto too_large = [&] { fail("it is larger than any such file, " + std::to_string(most_bytes) + " bytes"); };
  const auto endless = [&] { fail("it is no file and gives more than " + std::to_string(kMostUnknown) + " bytes"); };
  std::error_code unused;
  if (std::filesystem::is_directory(path, unused)) fail("it is a folder, not a file");
  const std::unique_ptr<std::FILE, Close> file(std::fopen(path.c_str(), "rbe"));
  if (!file) fail(std::strerror(errno));
  const std::uintmax_t size = std::filesystem::file_size(path, unused);
  const bool known = !unused && size > 0;
  if (known && size > most_bytes) too_large();
  const std::size_t most = known ? most_bytes : std::min(most_bytes, kMostUnknown);
  std::string bytes;
  // One byte more than there should be shows the end, and what has grown meanwhile.
  for (std::size_t step = known ? static_cast<std::size_t>(size) + 1 : kStep;; step = kStep) {
    const std::size_t before = bytes.size();
    bytes.resize(std::min(before + step, most + 1));
    const std::size_t got = std::fread(bytes.data() + before, 1, bytes.size() - before, file.get());
    const bool ended = before + got < bytes.size();
    bytes.resize(before + got);
    if (std::ferror(file.get()) != 0) fail(std::strerror(errno));
    if (ended) return bytes;
    if (bytes.size() > most) most < most_bytes ? endless() : too_large();
  }
}

}  // namespace depthmocap

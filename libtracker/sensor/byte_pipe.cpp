#include "libtracker/sensor/byte_pipe.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "depthmocap/error.h"

namespace depthmocap {
namespace {

[[noreturn]] void fail(const std::string& what, const std::string& path, const std::string& advice = {}) {
  throw Error(what + ": " + std::strerror(errno), path, advice);
}

int connectTo(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) throw Error("is too long for a socket's name", path);
  std::copy(path.begin(), path.end(), address.sun_path);
  const int socket_file = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket_file < 0) fail("no socket can be made", path);
  if (connect(socket_file, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const int reason = errno;
    close(socket_file);
    errno = reason;
    fail("cannot be connected to", path, "does the program that sends frames listen there?");
  }
  return socket_file;
}

// Without waiting for a FIFO's other end: that is for the reader's patience.
int openPath(const std::string& path) {
  struct stat found = {};
  if (stat(path.c_str(), &found) != 0) fail("cannot be opened", path);
  if (S_ISSOCK(found.st_mode)) return connectTo(path);
  if (S_ISDIR(found.st_mode)) throw Error("is a folder", path, "a recording is replay:" + path);
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) fail("cannot be opened", path);
  return file;
}

// Until something can be read or the deadline; false: nothing came. poll() of a FIFO that nobody writes to yet waits.
bool waitUntil(int file, SensorClock::time_point deadline) {
  using std::chrono::milliseconds;
  const auto left = std::chrono::ceil<milliseconds>(deadline - SensorClock::now());
  constexpr milliseconds kLongest{3'600'000};  // fits poll's int; nobody is so patient
  pollfd waits{file, POLLIN, 0};
  return poll(&waits, 1, static_cast<int>(std::clamp(left, milliseconds{0}, kLongest).count())) > 0;
}

}  // namespace

BytePipe::BytePipe(const std::string& address)
    : file_(address == "-" ? STDIN_FILENO : openPath(address)), ours_(address != "-") {}

BytePipe::~BytePipe() {
  if (ours_) close(file_);
}

BytePipe::Take BytePipe::take(std::span<std::uint8_t> to, SensorClock::time_point deadline) {
  while (taken_ < to.size()) {
    if (!waitUntil(file_, deadline)) return Take::Waiting;
    const ssize_t got = read(file_, to.data() + taken_, to.size() - taken_);
    if (got == 0) return Take::Ended;
    if (got > 0) taken_ += static_cast<std::size_t>(got);
    if (got < 0 && errno != EINTR && errno != EAGAIN) {
      problem_ = std::strerror(errno);
      return Take::Failed;
    }
  }
  taken_ = 0;
  return Take::Whole;
}

}  // namespace depthmocap

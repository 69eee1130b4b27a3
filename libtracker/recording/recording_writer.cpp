#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/core/pending_file.h"
#include "libtracker/recording/png_file.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/recording_header.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {

constexpr double kLargestStep = 65535.0;
constexpr double kTimeSteps = 1e6;  // per second, as many as frames.csv shows

// Holds a folder as long as it is written: by this a writer at work is told from one that was killed.
class FolderLock {
 public:
  FolderLock() = default;
  ~FolderLock() { release(); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  // False where another writer holds it.
  bool take(const fs::path& folder) {
    release();
    file_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    return file_ < 0 || flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
  }
  void release() {
    if (file_ >= 0) close(file_);
    file_ = -1;
  }

 private:
  int file_ = -1;
};

void refuseToOverwrite(const fs::path& folder) {
  std::error_code failure;
  if (!fs::exists(folder, failure) || (fs::is_directory(folder, failure) && fs::is_empty(folder, failure))) return;
  FolderLock lock;
  if (!lock.take(folder)) throw Error("is being written by another program", folder.string(), "name a new folder");
  throw Error("exists already and is not overwritten", folder.string(), "remove it or name a new folder");
}

fs::path waitingName(fs::path folder) {
  return folder += ".partial";
}

bool holdsOnlyARecording(const fs::path& folder) {
  constexpr std::array<std::string_view, 4> kContent = {"recording.json", "frames.csv", "depth", "truth"};
  std::error_code failure;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failure)) {
    const std::string name = entry.path().filename().string();
    const bool ours = std::ranges::any_of(kContent, [&](std::string_view own) { return name.starts_with(own); });
    if (!ours) return false;
  }
  return !failure;
}

// A writer that was killed left it.
void removeLeftover(const fs::path& folder) {
  std::error_code failure;
  if (!fs::exists(fs::symlink_status(folder, failure))) return;
  FolderLock lock;
  if (!lock.take(folder)) throw Error("is being written by another program", folder.string(), "name a new folder");
  if (!fs::is_directory(fs::symlink_status(folder, failure)) || !holdsOnlyARecording(folder)) {
    throw Error("exists already and is not overwritten", folder.string(), "remove it or name a new folder");
  }
  fs::remove_all(folder, failure);
  if (failure) throw Error("cannot be removed: " + failure.message(), folder.string());
}

void makeFolder(const fs::path& folder, FolderLock& lock) {
  std::error_code failure;
  fs::create_directories(folder / "depth", failure);
  if (failure) throw Error("cannot be created: " + failure.message(), folder.string());
  if (!lock.take(folder)) throw Error("is being written by another program", folder.string(), "name a new folder");
}

std::uint16_t toSteps(float depth_m, double depth_unit_m) {
  const double steps = std::round(depth_m / depth_unit_m);
  return steps >= 1.0 && steps <= kLargestStep ? static_cast<std::uint16_t>(steps) : std::uint16_t{0};
}

}  // namespace

struct RecordingWriter::Impl {
  Impl() = default;
  ~Impl() {
    std::error_code unused;
    if (waiting) fs::remove_all(folder, unused);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  fs::path name;         // of the recording
  fs::path folder;       // where it is now
  bool waiting = false;  // in a folder of another name
  Appears appears = Appears::WithFirstFrame;
  FolderLock lock;
  RecordingInfo info;
  std::int64_t last_frame = -1;
  double last_time_s = 0;
  Image<std::uint16_t> raw;

  void append(const std::string& row) const;
  void appear();
};

// Opened for each row: a row is in the file when write() returns, and a row that did not fit is taken back.
void RecordingWriter::Impl::append(const std::string& row) const {
  const fs::path index_file = folder / "frames.csv";
  std::error_code unused;
  const std::uintmax_t size_before = fs::exists(index_file, unused) ? fs::file_size(index_file, unused) : 0;
  std::FILE* file = std::fopen(index_file.c_str(), "ab");
  const bool written = file != nullptr && std::fwrite(row.data(), 1, row.size(), file) == row.size();
  const bool closed = file != nullptr && std::fclose(file) == 0;
  if (written && closed) return;
  const int reason = errno;
  if (file != nullptr) fs::resize_file(index_file, size_before, unused);
  throw Error(std::string("cannot be written: ") + std::strerror(reason), index_file.string());
}

void RecordingWriter::Impl::appear() {
  std::error_code failure;
  fs::rename(folder, name, failure);
  if (failure) throw Error("cannot be created: " + failure.message(), name.string());
  folder = name;
  waiting = false;
}

RecordingWriter::RecordingWriter(const fs::path& path, const RecordingInfo& info, Appears appears)
    : impl_(std::make_unique<Impl>()) {
  impl_->name = path.has_filename() ? path : path.parent_path();  // "take/" is "take"
  impl_->info = info;
  impl_->folder = waitingName(impl_->name);
  impl_->appears = appears;
  refuseToOverwrite(impl_->name);
  removeLeftover(impl_->folder);
  makeFolder(impl_->folder, impl_->lock);
  impl_->waiting = true;
  writeRecordingHeader(impl_->folder / "recording.json", info);
  impl_->append("frame,time_s,file\n");
}

RecordingWriter::~RecordingWriter() = default;

void RecordingWriter::write(const DepthFrame& frame) {
  const CameraModel& camera = impl_->info.camera;
  DMC_CHECK(frame.depth.width == camera.width && frame.depth.height == camera.height);
  const double time_s = std::round(frame.time_s * kTimeSteps) / kTimeSteps;
  const bool first = impl_->last_frame < 0;
  if (frame.frame < 0 || (!first && (frame.frame <= impl_->last_frame || !(time_s > impl_->last_time_s)))) {
    throw Error(fmt::format("frame {} at {:.6f} s does not follow frame {} at {:.6f} s", frame.frame, frame.time_s,
                            impl_->last_frame, impl_->last_time_s),
                impl_->folder.string(), "frame numbers and times must grow");
  }
  impl_->raw.reset(camera.width, camera.height, 0);
  for (std::size_t i = 0; i < frame.depth.data.size(); ++i) {
    impl_->raw.data[i] = toSteps(frame.depth.data[i], impl_->info.depth_unit_m);
  }
  const std::string name = fmt::format("depth/{:06d}.png", frame.frame);
  writePng16(impl_->folder / name, impl_->raw);
  impl_->append(fmt::format("{},{:.6f},{}\n", frame.frame, time_s, name));
  if (impl_->waiting && impl_->appears == Appears::WithFirstFrame) impl_->appear();
  impl_->last_frame = frame.frame;
  impl_->last_time_s = time_s;
}

const fs::path& RecordingWriter::folder() const {
  return impl_->folder;
}

void RecordingWriter::finish() {
  syncFolder(impl_->folder);
  if (impl_->waiting && impl_->appears == Appears::WhenFinished) impl_->appear();
}

}  // namespace depthmocap

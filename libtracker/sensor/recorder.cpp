#include "libtracker/sensor/recorder.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "depthmocap/error.h"
#include "libtracker/recording/recording_header.h"

namespace depthmocap {

namespace {

constexpr double kQueue_s = 1.0;
constexpr std::size_t kShortestQueue = 4;  // frames

std::size_t queueLength(double fps) {
  return std::max(kShortestQueue, static_cast<std::size_t>(std::ceil(fps * kQueue_s)));
}

}  // namespace

Recorder::Recorder(std::filesystem::path folder, const RecordingInfo& info, bool wait_when_full,
                   std::size_t queue_frames)
    : folder_(std::move(folder)),
      info_(info),
      wait_when_full_(wait_when_full),
      capacity_(queue_frames > 0 ? queue_frames : queueLength(info.fps)),
      writer_(std::make_unique<RecordingWriter>(folder_, info_)),
      thread_([this] { run(); }) {}

Recorder::~Recorder() {
  join();
}

bool Recorder::push(const SensorFrame& frame) {
  std::unique_lock lock(mutex_);
  if (wait_when_full_) changed_.wait(lock, [this] { return queue_.size() < capacity_ || failure_; });
  if (failure_ || queue_.size() >= capacity_) {
    ++status_.dropped;
    return false;
  }
  DepthFrame copy;
  if (!free_.empty()) {
    copy = std::move(free_.back());
    free_.pop_back();
  }
  copy = frame.depth;
  queue_.push_back(std::move(copy));
  changed_.notify_all();
  return true;
}

void Recorder::run() {
  try {
    writeQueued(*writer_);
  } catch (const std::exception& error) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    status_.failure = error.what();
    status_.dropped += static_cast<std::int64_t>(queue_.size());
    queue_.clear();
    changed_.notify_all();
  }
}

void Recorder::writeQueued(RecordingWriter& writer) {
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !queue_.empty() || finishing_; });
    if (queue_.empty()) return;
    // Written outside the lock; it stays in the queue until then, so that the queue's length is what would be lost.
    const DepthFrame& frame = queue_.front();
    lock.unlock();
    writer.write(frame);
    lock.lock();
    ++status_.written;
    free_.push_back(std::move(queue_.front()));
    queue_.pop_front();
    changed_.notify_all();
  }
}

void Recorder::join() {
  {
    const std::lock_guard lock(mutex_);
    finishing_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Recorder::finish(std::int64_t missing) {
  join();
  if (status_.written > 0) noteWhatIsMissing(missing);
  if (failure_) std::rethrow_exception(failure_);
  if (status_.written > 0) writer_->finish();
}

void Recorder::noteWhatIsMissing(std::int64_t missing) const {
  RecordingInfo info = info_;
  auto header = nlohmann::json::parse(info.extra_json);
  header["recorder"] = {{"written", status_.written}, {"dropped", status_.dropped}, {"missing", missing}};
  info.extra_json = header.dump();
  try {
    writeRecordingHeader(folder_ / "recording.json", info);
  } catch (const Error&) {
    if (!failure_) throw;  // otherwise the disk is full, which the first failure says better
  }
}

RecorderStatus Recorder::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

}  // namespace depthmocap

#include "libtracker/sensor/replay_source.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/core/parse_number.h"
#include "libtracker/sensor/camera_driver.h"

namespace depthmocap {

namespace {

std::string checkAddress(std::optional<std::string_view> address) {
  return address.value_or("").empty() ? "replay needs a recording: replay:REC" : "";
}

std::unique_ptr<DepthSource> open(const std::string& recording, const SourceOptions& options) {
  return std::make_unique<ReplaySource>(openRecording(recording, {options.camera, options.depth_unit_m, 0}),
                                        options.speed);
}

std::string setSpeed(const std::string& text, SourceOptions& options) {
  const std::optional<double> speed = parseDouble(text);
  if (!speed || *speed < 0 || *speed > kFastestReplay) return "'" + text + "' is no number from 0 to 1000";
  options.speed = *speed;
  return "";
}

}  // namespace

ReplaySource::ReplaySource(std::unique_ptr<RecordingReader> reader, double speed)
    : reader_(std::move(reader)), speed_(speed) {
  DMC_CHECK(reader_ != nullptr && speed >= 0);
}

SensorClock::time_point ReplaySource::due(std::size_t i) const {
  if (waitsForReader()) return SensorClock::now();
  const std::chrono::duration<double> since_start((reader_->time(i) - reader_->time(0)) / speed_);
  return start_ + std::chrono::duration_cast<SensorClock::duration>(since_start);
}

SourceState ReplaySource::next(SensorFrame& frame, std::chrono::milliseconds timeout) {
  if (next_ >= reader_->frameCount()) return SourceState::Ended;
  const SensorClock::time_point deadline = SensorClock::now() + timeout;
  if (!ahead_) {
    try {
      reader_->read(next_, ahead_frame_);
    } catch (const Error& error) {
      problem_ = error.what();
      ++next_;
      return SourceState::Damaged;
    }
    ahead_ = true;
    if (start_ == SensorClock::time_point{}) start_ = SensorClock::now() - (due(next_) - start_);
  }
  const SensorClock::time_point taken = due(next_);
  std::this_thread::sleep_until(std::min(taken, deadline));
  if (taken > deadline) return SourceState::Waiting;
  std::swap(frame.depth, ahead_frame_);
  frame.depth.frame -= reader_->frameNumber(0);
  frame.depth.time_s -= reader_->time(0);
  frame.taken = taken;
  ahead_ = false;
  ++next_;
  return SourceState::Frame;
}

CameraDriver replayDriver() {
  return {.prefix = "replay",
          .title = "recordings",
          .names = {"replay:REC"},
          .remark = "a recording as if it were a camera",
          .options = {{"--speed", "FACTOR",
                       "Pace of replay: 1 as recorded, 2 twice as fast; 0 as fast as it goes, dropping nothing", "1",
                       setSpeed}},
          .check = checkAddress,
          .open = open,
          .list = nullptr};
}

}  // namespace depthmocap

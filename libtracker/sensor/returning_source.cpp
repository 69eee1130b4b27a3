#include "libtracker/sensor/returning_source.h"

#include <algorithm>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "depthmocap/error.h"

namespace depthmocap {

namespace {

bool sameCamera(const CameraModel& a, const CameraModel& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx && a.cy == b.cy;
}

}  // namespace

ReturningSource::ReturningSource(Open open, ReturnPolicy policy)
    : open_(std::move(open)),
      policy_(policy),
      source_(open_()),
      info_(source_->info()),
      last_sign_(SensorClock::now()) {}

SourceState ReturningSource::next(SensorFrame& frame, std::chrono::milliseconds timeout) {
  if (!source_ && !tryAgain(timeout)) return SourceState::Lost;
  const SourceState state = source_->next(frame, timeout);
  if (state == SourceState::Lost) return lose(source_->problem());
  if (state == SourceState::Damaged) problem_ = source_->problem();
  const SensorClock::time_point now = SensorClock::now();
  if (state != SourceState::Waiting) last_sign_ = now;
  if (now - last_sign_ > policy_.stall) {
    return lose(
        fmt::format("the camera has sent nothing for {} s", std::chrono::duration<double>(policy_.stall).count()));
  }
  if (state == SourceState::Frame) accept(frame);
  return state;
}

SourceState ReturningSource::lose(const std::string& why) {
  problem_ = why;
  source_.reset();
  last_sign_ = SensorClock::now();
  return SourceState::Lost;
}

bool ReturningSource::tryAgain(std::chrono::milliseconds timeout) {
  const SensorClock::time_point now = SensorClock::now();
  const SensorClock::time_point retry = last_sign_ + policy_.retry;
  std::this_thread::sleep_until(std::min(retry, now + timeout));
  if (retry > now + timeout) return false;
  last_sign_ = SensorClock::now();
  try {
    std::unique_ptr<DepthSource> source = open_();
    if (!sameCamera(source->info().camera, info_.camera)) {
      problem_ = "another camera was plugged in, with other pictures";
      return false;
    }
    source_ = std::move(source);
  } catch (const Error& error) {
    problem_ = error.what();
    return false;
  }
  last_sign_ = SensorClock::now();
  fresh_ = true;
  return true;
}

void ReturningSource::accept(SensorFrame& frame) {
  if (std::exchange(fresh_, false)) {
    ++returns_;
    if (any_frame_) {
      const double away_s = std::chrono::duration<double>(frame.taken - last_.taken).count();
      number_offset_ = last_.depth.frame + 1 - frame.depth.frame;
      time_offset_s_ = last_.depth.time_s + std::max(away_s, 1.0 / info_.fps) - frame.depth.time_s;
    }
  }
  frame.depth.frame += number_offset_;
  frame.depth.time_s += time_offset_s_;
  any_frame_ = true;
  last_.depth.frame = frame.depth.frame;
  last_.depth.time_s = frame.depth.time_s;
  last_.taken = frame.taken;
}

}  // namespace depthmocap

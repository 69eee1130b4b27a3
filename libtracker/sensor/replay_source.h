#pragma once
#include <memory>

#include "libtracker/sensor/depth_source.h"

namespace depthmocap {

// A recording played as if it were a camera: frame i comes out when its time has come.
class ReplaySource : public DepthSource {
 public:
  // `speed`: 1 = the recording's own pace, 2 = twice as fast; 0 = as fast as frames are asked for, none is ever late.
  explicit ReplaySource(std::unique_ptr<RecordingReader> reader, double speed = 1);
  [[nodiscard]] const RecordingInfo& info() const override { return reader_->info(); }
  SourceState next(SensorFrame& frame, std::chrono::milliseconds timeout) override;
  [[nodiscard]] std::string problem() const override { return problem_; }
  [[nodiscard]] bool waitsForReader() const override { return speed_ <= 0; }

 private:
  [[nodiscard]] SensorClock::time_point due(std::size_t i) const;

  std::unique_ptr<RecordingReader> reader_;
  double speed_;
  std::size_t next_ = 0;
  bool ahead_ = false;  // ahead_frame_ holds frame next_: read before it is due, so that reading costs no time then
  DepthFrame ahead_frame_;
  std::string problem_;
  SensorClock::time_point start_{};
};

}  // namespace depthmocap

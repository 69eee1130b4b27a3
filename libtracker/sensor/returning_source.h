#pragma once
#include <functional>
#include <memory>

#include "libtracker/sensor/depth_source.h"

namespace depthmocap {

// How long to wait for a camera.
struct ReturnPolicy {
  std::chrono::milliseconds stall{3000};  // a camera that sends nothing for so long is opened anew
  std::chrono::milliseconds retry{500};   // between two tries to open one that is gone
};

// A camera that may be unplugged and come back: opened again as soon as it is there. Numbers and times of its frames
// grow on; the gap in time is as long as the camera was away.
class ReturningSource : public DepthSource {
 public:
  using Open = std::function<std::unique_ptr<DepthSource>()>;

  // Opens the camera; what `open` throws the first time goes to the caller.
  explicit ReturningSource(Open open, ReturnPolicy policy = {});
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  SourceState next(SensorFrame& frame, std::chrono::milliseconds timeout) override;
  [[nodiscard]] std::string problem() const override { return problem_; }
  [[nodiscard]] std::int64_t returns() const override { return returns_; }

 private:
  SourceState lose(const std::string& why);
  bool tryAgain(std::chrono::milliseconds timeout);
  void accept(SensorFrame& frame);

  Open open_;
  ReturnPolicy policy_;
  std::unique_ptr<DepthSource> source_;  // null: the camera is gone
  RecordingInfo info_;
  std::string problem_;
  std::int64_t returns_ = 0;
  SensorClock::time_point last_sign_;  // of life, or the last try to open
  bool any_frame_ = false;
  bool fresh_ = false;  // opened again, and no frame since
  SensorFrame last_;    // number and times as handed out; no picture
  std::int64_t number_offset_ = 0;
  double time_offset_s_ = 0;
};

}  // namespace depthmocap

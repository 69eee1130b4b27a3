#pragma once
#include <deque>
#include <string>
#include <utility>

#include "libtracker/sensor/depth_source.h"
#include "tests/support/made_recording.h"

namespace depthmocap {

// A source that does what its script says: one entry a call of next(). Then it keeps to `at_end`.
class ScriptedSource : public DepthSource {
 public:
  struct Step {
    SourceState state = SourceState::Frame;
    int number = 0;
  };
  static Step frame(int number) { return {SourceState::Frame, number}; }

  explicit ScriptedSource(std::deque<Step> script, SourceState at_end = SourceState::Ended)
      : script_(std::move(script)), at_end_(at_end) {}
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  SourceState next(SensorFrame& frame, std::chrono::milliseconds) override {
    if (script_.empty()) return at_end_;
    const Step step = script_.front();
    script_.pop_front();
    if (step.state == SourceState::Frame) {
      frame.depth = patternFrame(info_.camera, step.number, info_.fps);
      frame.taken = SensorClock::now();
    }
    return step.state;
  }
  [[nodiscard]] std::string problem() const override { return "scripted problem"; }

 private:
  RecordingInfo info_ = smallCamera();
  std::deque<Step> script_;
  SourceState at_end_;
};

}  // namespace depthmocap

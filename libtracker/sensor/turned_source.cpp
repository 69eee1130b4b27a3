#include "libtracker/sensor/turned_source.h"

#include <utility>

#include "libtracker/recording/turned_recording.h"

namespace depthmocap {
namespace {

class TurnedSource : public DepthSource {
 public:
  TurnedSource(std::unique_ptr<DepthSource> source, int turn_deg)
      : source_(std::move(source)), turn_deg_(turn_deg), info_(source_->info()) {
    info_.camera = turnedCamera(info_.camera, turn_deg);
  }
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  SourceState next(SensorFrame& frame, std::chrono::milliseconds timeout) override {
    const SourceState state = source_->next(taken_, timeout);
    if (state != SourceState::Frame) return state;
    frame.depth.frame = taken_.depth.frame;
    frame.depth.time_s = taken_.depth.time_s;
    frame.taken = taken_.taken;
    turnDepth(taken_.depth.depth, turn_deg_, frame.depth.depth);
    return state;
  }
  [[nodiscard]] std::string problem() const override { return source_->problem(); }
  [[nodiscard]] bool waitsForReader() const override { return source_->waitsForReader(); }
  [[nodiscard]] std::int64_t returns() const override { return source_->returns(); }

 private:
  std::unique_ptr<DepthSource> source_;
  int turn_deg_;
  RecordingInfo info_;
  SensorFrame taken_;
};

}  // namespace

std::unique_ptr<DepthSource> turnedSource(std::unique_ptr<DepthSource> source, int turn_deg) {
  if (turn_deg == 0) return source;
  return std::make_unique<TurnedSource>(std::move(source), turn_deg);
}

}  // namespace depthmocap

#include "libtracker/session/pose_pipeline.h"

#include "libtracker/tracker/pose_fields.h"

namespace depthmocap {

PosePipeline::PosePipeline(Tracker& tracker, double look_ahead_s, double smooth, RunStats& stats)
    : tracker_(tracker), looks_ahead_(look_ahead_s > 0), waiting_(look_ahead_s), smoother_(smooth), stats_(stats) {}

TrackState PosePipeline::process(std::size_t index, DepthFrame& depth) {
  const TrackedFrame& tracked = tracker_.process(depth);
  stats_.addFrame(tracked);
  rate_.count();
  if (!looks_ahead_) {
    give(index, depth, tracked, tracker_.actor());
    return tracked.state;
  }
  const TrackState state = tracked.state;
  waiting_.add(index, depth, tracked, tracker_.actor());
  passOn();
  return state;
}

void PosePipeline::finish() {
  waiting_.finish();
  passOn();
}

void PosePipeline::tell(const SessionStatus& status) {
  for (FrameSink* sink : sinks_) sink->onStatus(status);
}

void PosePipeline::passOn() {
  while (const LookAhead::Frame* frame = waiting_.next())
    give(frame->index, frame->depth, frame->tracked, frame->actor);
}

void PosePipeline::give(std::size_t index, const DepthFrame& depth, const TrackedFrame& tracked, const Actor& actor) {
  const auto start = RateMeter::Clock::now();
  const SessionFrame frame{index, depth, smoothed(tracked, actor), rate_.perSecond()};
  for (FrameSink* sink : sinks_) sink->onFrame(frame);
  stats_.addWrite(millisecondsSince(start));
}

const TrackedFrame& PosePipeline::smoothed(const TrackedFrame& tracked, const Actor& actor) {
  if (!smoother_.on()) return tracked;
  if (tracked.state == TrackState::Lost) {
    smoother_.reset();
    return tracked;
  }
  if (tracked.R_world_camera != smoothed_.R_world_camera) smoother_.reset();
  smoothed_ = tracked;
  setPose(smoother_.smooth(tracked.q, tracked.time_s), actor, fk_, smoothed_);
  return smoothed_;
}

}  // namespace depthmocap

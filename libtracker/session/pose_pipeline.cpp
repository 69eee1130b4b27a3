#include "libtracker/session/pose_pipeline.h"

#include "libtracker/tracker/frame_evidence.h"
#include "libtracker/tracker/pose_fields.h"

namespace depthmocap {

PosePipeline::PosePipeline(Tracker& tracker, double look_ahead_s, double smooth, RunStats& stats)
    : tracker_(tracker),
      looks_ahead_(look_ahead_s > 0),
      waiting_(look_ahead_s, tracker.people().size()),
      lanes_(tracker.people().size(), Lane{PoseSmoother(smooth), {}}),
      leaving_(lanes_.size()),
      seen_(lanes_.size()),
      stats_(stats) {}

TrackState PosePipeline::process(std::size_t index, DepthFrame& depth) {
  const TrackState state = tracker_.process(depth).state;
  stats_.addFrame(tracker_.people());
  rate_.count();
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    const TrackedFrame* tracked = tracker_.people()[i];
    seen_[i] = {tracked, &tracker_.actor(tracked->person), &FrameEvidence::of(tracker_, tracked->person)};
  }
  if (looks_ahead_) {
    waiting_.add(index, depth, seen_);
    passOn();
    return state;
  }
  for (std::size_t i = 0; i < lanes_.size(); ++i) {
    leaving_[i] = &smoothed(*seen_[i].tracked, *seen_[i].actor, lanes_[i]);
  }
  give(index, depth);
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
  while (const LookAhead::Frame* frame = waiting_.next()) {
    for (std::size_t i = 0; i < lanes_.size(); ++i) {
      const LookAhead::Person& person = frame->people[i];
      leaving_[i] = &smoothed(person.tracked, person.actor, lanes_[i]);
    }
    give(frame->index, frame->depth);
  }
}

void PosePipeline::give(std::size_t index, const DepthFrame& depth) {
  const auto start = RateMeter::Clock::now();
  const SessionFrame frame{index, depth, *leaving_.front(), rate_.perSecond(), leaving_};
  for (FrameSink* sink : sinks_) sink->onFrame(frame);
  stats_.addWrite(millisecondsSince(start));
}

const TrackedFrame& PosePipeline::smoothed(const TrackedFrame& tracked, const Actor& actor, Lane& lane) {
  if (!lane.smoother.on()) return tracked;
  if (tracked.state == TrackState::Lost) {
    lane.smoother.reset();
    return tracked;
  }
  if (tracked.R_world_camera != lane.smoothed.R_world_camera) lane.smoother.reset();
  lane.smoothed = tracked;
  setPose(lane.smoother.smooth(tracked.q, tracked.time_s), actor, fk_, lane.smoothed);
  return lane.smoothed;
}

}  // namespace depthmocap

#pragma once
#include <memory>
#include <string>

#include "depthmocap/track_state.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Sends poses as VR trackers (OSC over UDP) to VRChat: per frame one bundle of less than 1,500 bytes with position and
// rotation of each tracker of vrTrackers. The floor is y = 0 (FloorOrigin).
class TrackerSender {
 public:
  // `target` is HOST:PORT; Error where it is none or the host is unknown.
  explicit TrackerSender(const std::string& target);
  ~TrackerSender();
  TrackerSender(TrackerSender&&) noexcept;
  // While the actor is lost nothing is sent. That nobody listens is no failure.
  void send(double time_s, TrackState state, const BoneLengths& lengths, const Pose& q);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap

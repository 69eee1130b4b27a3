#pragma once
#include <memory>
#include <string>

#include "depthmocap/track_state.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Sends poses by the VMC protocol (OSC over UDP) to a program that shows an avatar: per frame two bundles of less than
// 1,500 bytes with /VMC/Ext/OK, T, Root/Pos and Bone/Pos (docs/guide/page-and-streams.md).
class VmcSender {
 public:
  // `target` is HOST:PORT; Error where it is none or the host is unknown.
  explicit VmcSender(const std::string& target);
  ~VmcSender();
  VmcSender(VmcSender&&) noexcept;
  // While the actor is lost only OK and T are sent. That nobody listens is no failure.
  void send(double time_s, TrackState state, const BoneLengths& lengths, const Pose& q);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap

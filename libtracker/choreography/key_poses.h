#pragma once
#include <vector>

#include "libtracker/choreography/arm_ik.h"
#include "libtracker/choreography/body_frame.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// A foot relative to where the actor stands, whose heading is 0.
struct FootKey {
  double out = 0.11;      // [m] away from the middle
  double forward = 0.0;   // [m]
  double lift = 0.0;      // [m] above the ground
  double pitch = 0.0;     // [rad] > 0 heel up
  double toe_out = 0.15;  // [rad]
  double ground = 0.0;    // [m] height of what it stands on
  double knee_out = 0.0;  // [rad]
};

// One key of a motion: a whole body posture at a time. Hands are relative to the shoulders (HandTarget).
struct KeyPose {
  double time_s = 0;
  PelvisState pelvis;
  SpineState spine;
  HeadState head;
  HandTarget left, right;
  FootKey left_foot, right_foot;
};

// How one performance of a key-pose motion differs from the table.
struct Performance {
  double tempo = 1.0;          // > 1 faster
  double hand_spread = 0.03;   // [m] random displacement of every hand key
  double angle_spread = 0.04;  // [rad] of every trunk key
  double heel_rise = 0.30;     // [rad] how far heels may come up by themselves
  bool hops = false;           // both feet may leave the floor at once; otherwise one steps after the other
};

// Keys in time order.
class KeySequence {
 public:
  // Adds a posture `after_s` after the last key; its own time does not count. The first key may be at 0. The reference
  // stays valid until the next call.
  KeyPose& add(const KeyPose& pose, double after_s);
  // There must be one.
  KeyPose& last();
  [[nodiscard]] double end() const { return keys_.empty() ? 0.0 : keys_.back().time_s; }
  [[nodiscard]] const std::vector<KeyPose>& keys() const { return keys_; }

 private:
  std::vector<KeyPose> keys_;
};

// Frames through the keys: shape-preserving cubic splines (Fritsch and Carlson 1980) in joint angles for trunk and
// arms, arms a little behind the trunk; a foot that changes its place between two keys is lifted on the way.
BodyFrames playKeys(const Skeleton& skeleton, const KeySequence& sequence, const Performance& performance,
                    Random& random);

}  // namespace depthmocap

#pragma once
#include "depthmocap/actor.h"

namespace depthmocap {

// Fits the stature of an uncalibrated actor while tracking: a running mean of the per-frame scale of the skeleton, over
// the first frames only, so that the size is fixed afterwards.
class SizeAdapter {
 public:
  // A calibrated actor is never adapted.
  SizeAdapter(const Actor& actor, bool calibrated, double adapt_s)
      : actor_(actor), remaining_s_(calibrated ? 0.0 : adapt_s) {}

  [[nodiscard]] const Actor& actor() const { return actor_; }
  [[nodiscard]] bool adapting() const { return remaining_s_ > 0; }
  // `scale`: how much larger than the present skeleton one frame's markers are; `dt_s`: time that the frame stands for,
  // 0 for one that shows too little to settle the size.
  void observe(double scale, double dt_s);
  // The present size times `scale`, at once: for the first pose.
  void rescale(double scale);

 private:
  Actor actor_;
  double remaining_s_;
  int observed_ = 0;
};

}  // namespace depthmocap

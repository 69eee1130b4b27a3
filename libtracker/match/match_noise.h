#pragma once
#include <span>

#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/surface_match.h"

namespace depthmocap {

// How far the matches of one person lie off the fitted body, learned from the frames before: the noise of the sensor at
// the person's distance, whatever camera it is, and what the body's shape lacks. Matches of a precise camera, and of a
// body of the right shape, count more.
class MatchNoise {
 public:
  struct Range {
    double usual_m;      // [m] deviation of matches that are worth 1
    double least, most;  // worth
    double power;        // (> 0) of the worth in usual over observed deviation
  };
  // At first matches are as good as `first_m` [m].
  MatchNoise(const Range& range, double first_m) : range_(range), deviation_m_(first_m) {}

  // The fit of a frame: its matches of one kind, and the body as fitted.
  void observe(std::span<const SurfaceMatch> matches, const ForwardKinematics& fk);
  // What a match is worth against one of usual noise.
  [[nodiscard]] double information() const;
  [[nodiscard]] double deviation_m() const { return deviation_m_; }  // [m]

 private:
  Range range_;
  double deviation_m_;
};

}  // namespace depthmocap

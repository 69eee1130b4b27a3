#pragma once
#include <span>

#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/surface_match.h"

namespace depthmocap {

// How far the measured points of one person lie off the fitted surface, learned from the frames before: the noise of
// the sensor at the person's distance, whatever camera it is, and what the body's shape lacks. Matches of a precise
// camera count more.
class MatchNoise {
 public:
  // The fit of a frame: its matches of measured points, and the body as fitted.
  void observe(std::span<const SurfaceMatch> matches, const ForwardKinematics& fk);
  // What a match is worth against one of usual noise.
  [[nodiscard]] double information() const;
  [[nodiscard]] double deviation_m() const { return deviation_m_; }  // [m]

 private:
  static constexpr double kUsual_m =
      0.010;  // [m] of a Kinect v1 on walks, at which MapConfig::lambda_surface was chosen
  double deviation_m_ = kUsual_m;
};

}  // namespace depthmocap

#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"

namespace depthmocap {

// Faults of an actor's T-pose, in the order in which they are reported.
enum class TPoseFault {
  None,
  Nobody,
  TwoPeople,
  OutOfImage,
  TooNear,
  TooFar,
  NoPersonsSize,
  ArmsNotOut,
  ArmsNotLevel,
  Turned,
  PartsMissing,
};

struct TPoseVerdict {
  TPoseFault fault = TPoseFault::Nobody;
  std::string advice;    // what to change, one sentence without a full stop; empty for a good frame
  double deviation = 0;  // [rad] of the worst angle from a T-pose; only for a good frame
  [[nodiscard]] bool good() const { return fault == TPoseFault::None; }
};

struct TPoseCheckConfig {
  double tolerance_rad = 0.26;  // [rad] (> 0) arms from level, and the body from facing the camera
  double min_distance_m = 1.2;  // [m] (> 0) of the body from the camera
  double max_distance_m = 4.5;  // [m] (> min_distance_m)
  double min_stature_m = 1.10;  // [m] (> 0) measured from crown to sole
  double max_stature_m = 2.30;  // [m]
  void validate() const;        // throws Error naming field, value and rule
};

// The outline of a standing person in the camera's upright world (y up, z towards the camera) [m].
struct BodyOutline {
  double top = 0, bottom = 0;                           // y
  double middle_x = 0;                                  // of the head
  double distance = 0;                                  // of the body along the optical axis
  Eigen::Vector3d left_hand = Eigen::Vector3d::Zero();  // outermost points; the actor's left is +x
  Eigen::Vector3d right_hand = Eigen::Vector3d::Zero();
  [[nodiscard]] double height() const { return top - bottom; }
};
// Needs at least 100 points.
BodyOutline measureOutline(const std::vector<Eigen::Vector3f>& points_world);

// Judges by outline alone, so that it also holds where parts are not recognised.
TPoseVerdict checkTPose(const MaskImage& mask, const BodyOutline& outline, const TPoseCheckConfig& config);

}  // namespace depthmocap

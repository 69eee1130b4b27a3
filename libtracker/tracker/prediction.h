#pragma once
#include <optional>

#include "depthmocap/joints.h"
#include "depthmocap/marker_set.h"
#include "depthmocap/pose.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {

// The state of the actor that the previous frames predict for the next one.
struct Prediction {
  double time_s = 0;                                      // of the frame
  double dt_s = 0;                                        // [s] since the frame before; 0 for the first one
  std::optional<ExpectedActor> actor;                     // where to look; none: anybody may be the actor
  bool has_pose = false;                                  // otherwise the following members are undefined
  Pose q = Pose::Zero();                                  // at constant velocity; world
  Pose q_prev = Pose::Zero();                             // q_-1
  Pose q_prev2 = Pose::Zero();                            // q_-2
  MarkerSet markers_camera;                               // where q puts its markers [m]
  JointPositions joints_camera = JointPositions::Zero();  // [m]
};

}  // namespace depthmocap

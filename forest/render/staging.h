#pragma once
#include <vector>

#include "depthmocap/world_frame.h"
#include "libtracker/body/body_surface.h"
#include "libtracker/skeleton/motion_clip.h"

namespace depthmocap {

// Where an actor performs in front of a camera that stands level.
struct StagingConfig {
  double yaw = 0;                 // [rad] heading in the first frame: 0 faces the camera, positive turns to its right
  double distance_m = 2.7;        // [m] (> 0) camera to the middle of the path, along the floor
  double min_distance_m = 1.9;    // [m] (> 0) nearer than this no part of the path is wanted,
  double max_distance_m = 5.6;    // [m] nor farther than this; a distance_m outside widens the range
  double half_view = 0.55;        // (> 0) tangent of half the horizontal field of view
  double camera_height_m = 0.95;  // [m] (> 0) above the floor
};

// A motion in the camera's default world (uprightWorldFromCamera): y up, z towards the camera, the camera at the
// origin.
struct StagedMotion {
  std::vector<Pose> poses;
  double floor_y = 0;     // [m] height of the floor, negative
  double path_scale = 1;  // (0, 1] below 1 the path was too long for the view and was shortened: feet slide
};

// Puts a motion on a body and in front of the camera. Angles are kept; the path is scaled by the ratio of the leg
// lengths and turned so that the first frame's heading is `yaw`; the middle of its extent lies on the optical axis at
// distance_m, also where the view is too narrow there for the whole body. A path that would leave the view or the range
// of distances is first moved back, then shortened about its middle. The lowest foot is as far above the floor as the
// performer's was (scaled), so that what stood still stands and what jumped jumps; where another part of the body would
// be below the floor (a fall, a handstand), the body is lifted by as much. Throws Error where the clip is empty or a
// setting is out of range.
StagedMotion stageMotion(const MotionClip& clip, const BodySurface& body, const StagingConfig& config);

}  // namespace depthmocap

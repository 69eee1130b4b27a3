#pragma once
#include <Eigen/Core>

#include "depthmocap/camera_model.h"
#include "depthmocap/joints.h"
#include "libtracker/core/classified_pixels.h"

namespace depthmocap {

// Beyond the paper: what an arm or a leg looks like hardly tells whether it is the left or the right one, but where it
// was a moment ago does. Moves the probability of each pixel between a part and its mirror (never to another part)
// towards the one whose bone is expected to be near. `joints_camera` [m]: the joints at the predicted pose, camera
// frame.
void expectSides(const JointPositions& joints_camera, const CameraModel& camera, int threads, ClassifiedPixels& pixels);

}  // namespace depthmocap

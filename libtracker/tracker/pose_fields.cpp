#include "libtracker/tracker/pose_fields.h"

#include "libtracker/tracker/alignment.h"

namespace depthmocap {

void setPose(const Pose& q, const Actor& actor, ForwardKinematics& fk, TrackedFrame& frame) {
  const Eigen::Matrix3d R_camera_world = frame.R_world_camera.transpose();
  frame.q = q;
  frame.model_markers_camera = rotated(R_camera_world, modelMarkers(actor, q, fk));
  frame.joints_camera = R_camera_world * jointPositions(actor.skeleton, q);
}

}  // namespace depthmocap

#pragma once
#include <Eigen/Core>
#include <optional>

#include "depthmocap/camera_model.h"
#include "depthmocap/world_frame.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {

// The world that poses are given in: the camera is its origin, y points up, and the camera looks along -z, seen from
// above. Up is away from the floor; without a floor, and of a camera that stands level, it is the camera's own
// (uprightWorldFromCamera()). The world stays as it is until the floor says clearly that the camera stands otherwise.
class UprightWorld {
 public:
  // What was found of the floor in the next frame. Where the world is another one from this frame on, how it turned:
  // p_new = R * p_before.
  std::optional<Eigen::Matrix3d> observe(const Segmentation& segmentation);

  [[nodiscard]] const Eigen::Matrix3d& R_world_camera() const { return R_world_camera_; }
  // The floor in the world: n.p + d = 0, |n| = 1, n up; [m]. The mean of what was found since the camera last moved;
  // none where the present picture has no floor.
  [[nodiscard]] std::optional<Eigen::Vector4d> floor() const;

 private:
  void take(const Eigen::Vector4d& found);

  Eigen::Matrix3d R_world_camera_ = uprightWorldFromCamera();
  std::optional<Eigen::Vector4d> found_;  // the last plane that was found, camera frame
  std::optional<Eigen::Vector4d> floor_;  // mean of those that agree, camera frame
  int agreeing_ = 0;                      // planes in floor_
  bool from_floor_ = false;               // a floor has said how the camera stands
};

}  // namespace depthmocap

#pragma once
#include <Eigen/Core>
#include <optional>

#include "libtracker/core/camera.h"
#include "libtracker/core/image.h"

namespace depthmocap {

struct SegmentConfig {
  double min_depth_m = 0.4;         // [m] nearer measurements are dropped
  double max_depth_m = 6.0;         // [m] farther ones too
  double floor_distance_m = 0.05;   // [m] within this distance of the floor plane is floor
  double cluster_gap_m = 0.10;      // [m] points farther apart belong to different clusters
  double min_height_m = 0.5;        // [m] (a person's cluster is at least this tall, unless cut by the image border)
  double max_height_m = 2.4;        // [m]
  int min_pixels = 400;             // [px] at 320x240; scaled with the image
  void validate() const;
};

struct Segmentation {
  MaskImage mask;            // 1 on the actor; empty actor = all 0
  int pixel_count = 0;       // [px] in the mask
  bool touches_border = false;
  Eigen::Vector3d centroid_camera = Eigen::Vector3d::Zero();  // [m]
  std::optional<Eigen::Vector4d> floor_camera;  // plane n.p + d = 0, |n| = 1, n away from the floor (up); if seen
};

}  // namespace depthmocap

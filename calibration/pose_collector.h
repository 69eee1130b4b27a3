#pragma once
#include <vector>

#include "calibration/pose_observation.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/tracked_frame.h"

namespace depthmocap {

// Beyond the paper: a straight arm does not show where its elbow is. Gathers frames of a tracked recording in which
// joints are bent, for a second solve together with the T-pose.
class PoseCollector {
 public:
  // `points_per_part` of each frame's cloud are kept.
  PoseCollector(const CameraModel& camera, int points_per_part);

  // Looks at a tracked frame; keeps it if the tracker is sure of it.
  void add(const DepthFrame& frame, const TrackedFrame& tracked);
  // At most `count` frames whose poses differ most from the T-pose and from each other; observations of total weight 1.
  [[nodiscard]] std::vector<PoseObservation> chosen(int count) const;

 private:
  CameraModel camera_;
  int points_per_part_;
  std::vector<PoseObservation> candidates_;
};

}  // namespace depthmocap

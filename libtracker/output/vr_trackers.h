#pragma once
#include <Eigen/Core>
#include <array>
#include <string_view>

#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// A tracker as VRChat reads it, in Unity's world: left-handed, x right, y up, z forward.
struct VrTracker {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();   // [m]
  Eigen::Vector3d euler_deg = Eigen::Vector3d::Zero();  // about x, y, z; applied z, x, y. 0 in the T-pose
};

inline constexpr int kVrTrackerCount = 9;
// The addresses below /tracking/trackers/: hips, left and right foot, left and right knee (turned as the thigh), chest,
// left and right elbow (turned as the upper arm), and the head, by which VRChat lays the trackers over the player.
inline constexpr std::array<std::string_view, kVrTrackerCount> kVrTrackerNames = {"1", "2", "3", "4",   "5",
                                                                                  "6", "7", "8", "head"};

// Positions are relative to `origin` of our world [m].
std::array<VrTracker, kVrTrackerCount> vrTrackers(const Skeleton& skeleton, const Pose& q,
                                                  const Eigen::Vector3d& origin);

}  // namespace depthmocap

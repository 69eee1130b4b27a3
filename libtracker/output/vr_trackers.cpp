#include "libtracker/output/vr_trackers.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libtracker/output/unity_axes.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

// Where a tracker is worn on the chest, as a share of the way from the spine's joint to the neck.
constexpr double kChestShare = 0.6;

// Angles about x, y, z of R = Ry Rx Rz, Unity's order.
Eigen::Vector3d unityEulerDeg(const Eigen::Matrix3d& R) {
  const double x = std::asin(std::clamp(-R(1, 2), -1.0, 1.0));
  const bool locked = std::abs(R(1, 2)) > 1.0 - 1e-9;  // straight up or down: y and z turn about one axis
  const double y = locked ? std::atan2(-R(2, 0), R(0, 0)) : std::atan2(R(0, 2), R(2, 2));
  const double z = locked ? 0.0 : std::atan2(R(1, 0), R(1, 1));
  return Eigen::Vector3d(x, y, z) * (180.0 / std::numbers::pi);
}

}  // namespace

std::array<VrTracker, kVrTrackerCount> vrTrackers(const Skeleton& s, const Pose& q, const Eigen::Vector3d& origin) {
  ForwardKinematics fk;
  fk.update(s, q);
  const Eigen::Vector3d chest(0, kChestShare * (s.lengths.torso - s.lengths.spine), 0);
  // A point, and the bone that it is turned as.
  struct Worn {
    BonePoint at;
    Bone turned_as;
  };
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const std::array<Worn, kVrTrackerCount> worn = {{{{Bone::Root, zero}, Bone::Root},
                                                   {{Bone::LeftFoot, zero}, Bone::LeftFoot},
                                                   {{Bone::RightFoot, zero}, Bone::RightFoot},
                                                   {{Bone::LeftTibia, zero}, Bone::LeftFemur},
                                                   {{Bone::RightTibia, zero}, Bone::RightFemur},
                                                   {{Bone::UpperBack, chest}, Bone::UpperBack},
                                                   {{Bone::LeftRadius, zero}, Bone::LeftHumerus},
                                                   {{Bone::RightRadius, zero}, Bone::RightHumerus},
                                                   {{Bone::Head, s.head_center}, Bone::Head}}};
  std::array<VrTracker, kVrTrackerCount> trackers;
  for (std::size_t i = 0; i < worn.size(); ++i) {
    trackers[i].position = inUnity(Eigen::Vector3d(fk.position(worn[i].at) - origin));
    const Eigen::Quaterniond turned(fk.R_world_bone(worn[i].turned_as));
    trackers[i].euler_deg = unityEulerDeg(inUnity(turned).toRotationMatrix());
  }
  return trackers;
}

}  // namespace depthmocap

#include "libtracker/clinical/joint_angles.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "depthmocap/world_frame.h"
#include "libtracker/clinical/anatomical.h"

namespace depthmocap {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

// Joints of one side and its angles, from joints in a world with y up.
class SideAngles {
 public:
  SideAngles(const JointPositions& p, BodySide side) : p_(p), side_(side) {}

  void write(const Eigen::Matrix3d& R_world_trunk, ClinicalAngles& angles) const {
    set(angles, "knee_flexion", bend("hip", "knee", "ankle"));
    set(angles, "elbow_flexion", bend("shoulder", "elbow", "wrist"));
    set(angles, "ankle_dorsiflexion", bend("knee", "ankle", "toe") - restingFoot());
    const double outward = -mirrorSign(side_);
    const Eigen::Vector3d thigh = (R_world_trunk.transpose() * (at("knee") - at("hip"))).normalized();
    set(angles, "hip_flexion", std::atan2(thigh.z(), -thigh.y()));
    set(angles, "hip_abduction", std::asin(std::clamp(outward * thigh.x(), -1.0, 1.0)));
    const Tilt arm = tiltFromDown((R_world_trunk.transpose() * (at("elbow") - at("shoulder"))).normalized());
    set(angles, "shoulder_elevation", arm.angle);
    set(angles, "shoulder_flexion", arm.forward);
    set(angles, "shoulder_abduction", outward * arm.left);
  }

  // [m] of the lower of heel and toes, and of the ankle before the pelvis.
  [[nodiscard]] double sole() const {
    BoneLengths lengths;
    lengths.lower_leg = (at("ankle") - at("knee")).norm();
    lengths.foot = (at("toe") - at("ankle")).norm();
    const double ankle_m = ankleHeight(lengths);
    return std::min(at("ankle").y() - ankle_m, at("toe").y() - ankle_m - makeSkeleton(lengths).left_toe.y());
  }
  [[nodiscard]] double ahead(const Eigen::Vector3d& forward) const {
    return forward.dot(at("ankle") - p_.col(static_cast<int>(Joint::Pelvis)));
  }

 private:
  [[nodiscard]] std::string prefix() const { return side_ == BodySide::Left ? "left_" : "right_"; }
  [[nodiscard]] Eigen::Vector3d at(const char* joint) const {
    const std::string name = prefix() + joint;
    const auto found = std::find(kJointNames.begin(), kJointNames.end(), name);
    return p_.col(found - kJointNames.begin());
  }
  [[nodiscard]] double bend(const char* a, const char* b, const char* c) const {
    const Eigen::Vector3d before = at(b) - at(a);
    const Eigen::Vector3d after = at(c) - at(b);
    return std::atan2(before.cross(after).norm(), before.dot(after));
  }
  // Between shank and foot where the foot stands flat below an upright shank.
  static double restingFoot() {
    static const Eigen::Vector3d toe = makeSkeleton(BoneLengths{}).left_toe.normalized();
    return std::acos(-toe.y());
  }
  void set(ClinicalAngles& angles, const char* name, double rad) const {
    angles[clinicalAngleIndex(prefix() + name)] = kDegrees * rad;
  }

  const JointPositions& p_;
  BodySide side_;
};

// Axes of the trunk: x along the hips to the left, y to the neck, z forward.
Eigen::Matrix3d trunkAxes(const JointPositions& p) {
  const auto at = [&](Joint joint) { return Eigen::Vector3d(p.col(static_cast<int>(joint))); };
  const Eigen::Vector3d up = (at(Joint::Neck) - at(Joint::Pelvis)).normalized();
  const Eigen::Vector3d forward = (at(Joint::LeftHip) - at(Joint::RightHip)).cross(up).normalized();
  Eigen::Matrix3d R;
  R << up.cross(forward), up, forward;
  return R;
}

AnglesRow anglesOf(const JointsRow& joints) {
  AnglesRow row;
  row.frame = joints.frame;
  row.time_s = joints.time_s;
  row.state = joints.state;
  row.person = joints.person;
  if (joints.state == TrackState::Lost) return row;
  row.angles.setConstant(std::numeric_limits<double>::quiet_NaN());
  row.confidence = clinicalConfidence(joints.confidence);
  const JointPositions p = uprightWorldFromCamera() * joints.p_camera;
  const Eigen::Matrix3d R_world_trunk = trunkAxes(p);
  const SideAngles left(p, BodySide::Left);
  const SideAngles right(p, BodySide::Right);
  left.write(R_world_trunk, row.angles);
  right.write(R_world_trunk, row.angles);
  Eigen::Vector3d forward = R_world_trunk.col(2);
  forward.y() = 0;
  if (forward.norm() > 1e-6) forward.normalize();
  row.signals = {p(1, static_cast<int>(Joint::Pelvis)), left.sole(), right.sole(), left.ahead(forward),
                 right.ahead(forward)};
  return row;
}

}  // namespace

std::vector<AnglesRow> anglesOfJoints(const std::vector<JointsRow>& rows) {
  std::vector<AnglesRow> angles;
  angles.reserve(rows.size());
  for (const JointsRow& row : rows) angles.push_back(anglesOf(row));
  return angles;
}

}  // namespace depthmocap

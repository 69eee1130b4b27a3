#include "libtracker/clinical/anatomical.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace depthmocap {

Eigen::Matrix3d armInThorax(const ForwardKinematics& fk, BodySide side) {
  const double to_t_pose = -mirrorSign(side) * std::numbers::pi / 2.0;
  return relativeRotation(fk, Bone::UpperBack, bonesOf(side).humerus) *
         Eigen::AngleAxisd(to_t_pose, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

double elbowFlexion(const ForwardKinematics& fk, BodySide side) {
  const Eigen::Matrix3d R = relativeRotation(fk, bonesOf(side).humerus, bonesOf(side).radius);
  return mirrorSign(side) * std::atan2(R(0, 2), R(0, 0));
}

double kneeFlexion(const ForwardKinematics& fk, BodySide side) {
  const Eigen::Matrix3d R = relativeRotation(fk, bonesOf(side).femur, bonesOf(side).tibia);
  return std::atan2(R(2, 1), R(1, 1));
}

FootAngles footAngles(const ForwardKinematics& fk, BodySide side) {
  const Eigen::Vector3d toes = relativeRotation(fk, bonesOf(side).tibia, bonesOf(side).foot).col(2);
  return {std::atan2(toes.y(), toes.z()), mirrorSign(side) * std::asin(std::clamp(toes.x(), -1.0, 1.0))};
}

Tilt tiltFromDown(const Eigen::Vector3d& direction) {
  const double across = std::hypot(direction.x(), direction.z());
  const double angle = std::atan2(across, -direction.y());
  const double share = across > 1e-9 ? angle / across : 0.0;
  return {angle, share * direction.z(), share * direction.x()};
}

}  // namespace depthmocap

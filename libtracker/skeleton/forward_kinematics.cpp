#include "libtracker/skeleton/forward_kinematics.h"

#include <cmath>
#include <initializer_list>
#include <utility>

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d skew(const Vector3d& v) {
  Matrix3d m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

// A rotation vector's rotation exp(w) by Rodrigues' formula, and the left Jacobian of SO(3), d exp(w) = [J dw]x exp(w);
// with the series near zero.
struct Exponential {
  Matrix3d R;
  Matrix3d J;

  explicit Exponential(const Vector3d& w) {
    const double theta2 = w.squaredNorm();
    const double theta = std::sqrt(theta2);
    const double sine = std::sin(theta);
    const double a = theta < 1e-4 ? 1.0 - theta2 / 6.0 : sine / theta;
    const double b = theta < 1e-4 ? 0.5 - theta2 / 24.0 : (1.0 - std::cos(theta)) / theta2;
    const double c = theta < 1e-3 ? 1.0 / 6.0 - theta2 / 120.0 : (theta - sine) / (theta2 * theta);
    const Matrix3d K = skew(w);
    const Matrix3d K2 = w * w.transpose() - theta2 * Matrix3d::Identity();  // K K
    R = Matrix3d::Identity() + a * K + b * K2;
    J = Matrix3d::Identity() + b * K + c * K2;
  }
};

// A bone's local rotation and, per DoF, the axis a_i with d R / d q_i = [a_i]x R, in the parent's frame.
struct Local {
  Matrix3d R;
  std::array<Vector3d, 3> axis;
};

Local swingThenTwist(const Vector3d& swing, int twist_axis, double twist, const std::array<int, 3>& axis_of_dof) {
  Local local;
  const auto [S, J] = Exponential(swing);
  local.R = S * Eigen::AngleAxisd(twist, Vector3d::Unit(twist_axis)).toRotationMatrix();
  for (std::size_t i = 0; i < 3; ++i) {
    const int axis = axis_of_dof[i];
    local.axis[i] = axis == twist_axis ? Vector3d(S.col(twist_axis)) : Vector3d(J.col(axis));
  }
  return local;
}

Local pureSwing(const Vector3d& swing, int first_axis, int second_axis) {
  const auto [R, J] = Exponential(swing);
  return {R, {J.col(first_axis), J.col(second_axis), Vector3d::Zero()}};
}

Local hinge(double angle, int axis) {
  return {Eigen::AngleAxisd(angle, Vector3d::Unit(axis)).toRotationMatrix(),
          {Vector3d::Unit(axis), Vector3d::Zero(), Vector3d::Zero()}};
}

Local headingTilt(const Vector3d& q) {
  const Matrix3d H = Eigen::AngleAxisd(q.y(), Vector3d::UnitY()).toRotationMatrix();
  const Vector3d tilt(q.x(), 0, q.z());
  const auto [R, J] = Exponential(tilt);
  return {H * R, {H * J.col(0), Vector3d::UnitY(), H * J.col(2)}};
}

Local localOf(Bone bone, const Pose& q) {
  const BoneDofs& dofs = kBoneDofs[static_cast<std::size_t>(bone)];
  const int i = dofs.first;
  switch (dofs.rotation) {
    case BoneRotation::HeadingTilt:
      return headingTilt(q.segment<3>(i));
    case BoneRotation::SwingTwistY:
      return swingThenTwist({q[i], 0, q[i + 2]}, 1, q[i + 1], {0, 1, 2});
    case BoneRotation::SwingTwistX:
      return swingThenTwist({0, q[i + 1], q[i + 2]}, 0, q[i], {0, 1, 2});
    case BoneRotation::SwingYZ:
      return pureSwing({0, q[i], q[i + 1]}, 1, 2);
    case BoneRotation::SwingXZ:
      return pureSwing({q[i], 0, q[i + 1]}, 0, 2);
    case BoneRotation::SwingXY:
      return pureSwing({q[i], q[i + 1], 0}, 0, 1);
    case BoneRotation::HingeX:
      return hinge(q[i], 0);
    case BoneRotation::HingeY:
      return hinge(q[i], 1);
  }
  return hinge(0, 0);
}

// The rotation vector w without component along `axis` that turns the axis to `direction` (unit).
Vector3d swingTo(const Vector3d& axis, const Vector3d& direction) {
  const Vector3d cross = axis.cross(direction);
  const double sine = cross.norm();
  const double angle = std::atan2(sine, axis.dot(direction));
  if (sine < 1e-12) return Vector3d::Zero();
  return cross * (angle / sine);
}

double angleAbout(const Matrix3d& R, int axis) {
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  return std::atan2(R(v, u) - R(u, v), R(u, u) + R(v, v));
}

// R = exp(swing) * R_axis(twist).
void decompose(const Matrix3d& R, int axis, Vector3d& swing, double& twist) {
  swing = swingTo(Vector3d::Unit(axis), R.col(axis));
  twist = angleAbout(Exponential(swing).R.transpose() * R, axis);
}

}  // namespace

void ForwardKinematics::update(const Skeleton& skeleton, const Pose& q) {
  for (std::size_t b = 0; b < kBoneCount; ++b) {
    const Local local = localOf(static_cast<Bone>(b), q);
    const int parent = kBoneParents[b];
    Matrix3d R_world_parent = Matrix3d::Identity();
    if (parent < 0) {
      p_world_[b] = q.head<3>();
    } else {
      const auto p = static_cast<std::size_t>(parent);
      R_world_parent = R_world_[p];
      p_world_[b] = R_world_parent * skeleton.offset[b] + p_world_[p];
    }
    R_world_[b] = R_world_parent * local.R;
    const BoneDofs& dofs = kBoneDofs[b];
    const auto first = static_cast<std::size_t>(dofs.first);
    for (std::size_t i = 0; i < static_cast<std::size_t>(dofs.count); ++i) {
      axis_world_[first + i] = R_world_parent * local.axis[i];
    }
  }
}

void ForwardKinematics::jacobian(const BonePoint& point, PointJacobian& J) const {
  J.setZero();
  J.leftCols<3>().setIdentity();
  const Vector3d p = position(point);
  for (int b = static_cast<int>(point.bone); b >= 0; b = kBoneParents[static_cast<std::size_t>(b)]) {
    const BoneDofs& dofs = kBoneDofs[static_cast<std::size_t>(b)];
    const Vector3d arm = p - p_world_[static_cast<std::size_t>(b)];
    for (int i = dofs.first; i < dofs.first + dofs.count; ++i) {
      J.col(i) = axis_world_[static_cast<std::size_t>(i)].cross(arm);
    }
  }
}

Matrix3d localRotation(Bone bone, const Pose& q) {
  return localOf(bone, q).R;
}

double setLocalRotation(Bone bone, const Matrix3d& R, Pose& q) {
  const BoneDofs& dofs = kBoneDofs[static_cast<std::size_t>(bone)];
  const int i = dofs.first;
  Vector3d swing;
  double twist = 0;
  switch (dofs.rotation) {
    case BoneRotation::HeadingTilt: {
      // R = Ry(h) exp(tilt): the transpose is a swing then a twist about y.
      decompose(R.transpose(), 1, swing, twist);
      q[i] = -swing.x();
      q[i + 1] = -twist;
      q[i + 2] = -swing.z();
      break;
    }
    case BoneRotation::SwingTwistY:
      decompose(R, 1, swing, twist);
      q.segment<3>(i) = Vector3d(swing.x(), twist, swing.z());
      break;
    case BoneRotation::SwingTwistX:
      decompose(R, 0, swing, twist);
      q.segment<3>(i) = Vector3d(twist, swing.y(), swing.z());
      break;
    case BoneRotation::SwingYZ:
      decompose(R, 0, swing, twist);
      q.segment<2>(i) = Eigen::Vector2d(swing.y(), swing.z());
      break;
    case BoneRotation::SwingXZ:
      decompose(R, 1, swing, twist);
      q.segment<2>(i) = Eigen::Vector2d(swing.x(), swing.z());
      break;
    case BoneRotation::SwingXY:
      decompose(R, 2, swing, twist);
      q.segment<2>(i) = Eigen::Vector2d(swing.x(), swing.y());
      break;
    case BoneRotation::HingeX:
      q[i] = angleAbout(R, 0);
      break;
    case BoneRotation::HingeY:
      q[i] = angleAbout(R, 1);
      break;
  }
  const Matrix3d rest = localOf(bone, q).R.transpose() * R;
  return Eigen::AngleAxisd(rest).angle();
}

JointPositions jointPositions(const Skeleton& skeleton, const Pose& q) {
  ForwardKinematics fk;
  fk.update(skeleton, q);
  const auto points = jointPoints(skeleton);
  JointPositions positions;
  for (int j = 0; j < kJointCount; ++j) positions.col(j) = fk.position(points[static_cast<std::size_t>(j)]);
  return positions;
}

Pose mirroredPose(const Pose& q) {
  // Mirroring x keeps rotations about x and negates those about y and z; sides swap.
  Pose m = q;
  const auto negate = [&](std::initializer_list<int> dofs) {
    for (int i : dofs) m[i] = -m[i];
  };
  const auto swap = [&](int right, int left, int count) {
    for (int i = 0; i < count; ++i) std::swap(m[right + i], m[left + i]);
  };
  swap(kRclavicleRy, kLclavicleRy, 2);
  swap(kRhumerusRx, kLhumerusRx, 3);
  swap(kRradiusRy, kLradiusRy, 1);
  swap(kRfemurRx, kLfemurRx, 3);
  swap(kRtibiaRx, kLtibiaRx, 1);
  swap(kRfootRx, kLfootRx, 2);
  negate({kRootTx,      kRootRy,     kRootRz,     kUpperbackRy, kUpperbackRz, kRclavicleRy, kRclavicleRz, kLclavicleRy,
          kLclavicleRz, kRhumerusRy, kRhumerusRz, kLhumerusRy,  kLhumerusRz,  kRradiusRy,   kLradiusRy,   kNeckRz,
          kHeadRy,      kRfemurRy,   kRfemurRz,   kLfemurRy,    kLfemurRz,    kRfootRy,     kLfootRy});
  return m;
}

}  // namespace depthmocap

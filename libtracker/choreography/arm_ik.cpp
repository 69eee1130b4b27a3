#include "libtracker/choreography/arm_ik.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "libtracker/choreography/easing.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

// Everything here is the left arm: x out, y up, z forward.

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kMinElbowFlexion = 0.05;  // [rad] nobody locks the elbow
constexpr double kMaxElbowFlexion = 2.62;
constexpr double kLimitMargin = 0.03;  // [rad] room for the natural noise

struct ElbowPreference {
  Vector3d hand;   // direction of the hand from the shoulder
  Vector3d elbow;  // where the elbow then lies off that line
};

// Relaxed elbow directions for the six main directions of the hand; in between they are blended.
const std::array<ElbowPreference, 6> kElbowPreferences = {{
    {{0, -1, 0}, {0.45, 0, -0.90}},
    {{0, 1, 0}, {0.85, 0, 0.50}},
    {{0, 0, 1}, {0.60, -0.80, 0}},
    {{0, 0, -1}, {0.90, 0.40, 0}},
    {{1, 0, 0}, {0, -0.75, -0.65}},
    {{-1, 0, 0}, {0, -0.70, 0.70}},
}};

Vector3d relaxedElbow(const Vector3d& hand) {
  Vector3d sum = Vector3d::Zero();
  for (const auto& preference : kElbowPreferences) {
    const double share = std::max(0.0, hand.dot(preference.hand));
    sum += share * share * preference.elbow.normalized();
  }
  return (sum - sum.dot(hand) * hand).normalized();
}

// The shoulder blade joins in once the arm is raised beyond about 30 degrees, and goes with reaching forward and
// across.
void followClavicle(const Vector3d& hand, double reach_share, ArmAngles& arm) {
  const double elevation = std::acos(std::clamp(-hand.y(), -1.0, 1.0));
  arm.clavicle_z = -0.04 + 0.50 * smoothStep((elevation - 0.6) / 2.4) * reach_share;
  const double forward = 0.22 * hand.z() + 0.18 * std::max(0.0, -hand.x());
  arm.clavicle_y = -forward * reach_share - 0.10 * std::max(0.0, -hand.z());
}

Matrix3d clavicleRotation(const ArmAngles& arm) {
  Pose q = Pose::Zero();
  q[kLclavicleRy] = arm.clavicle_y;
  q[kLclavicleRz] = arm.clavicle_z;
  return localRotation(Bone::LeftClavicle, q);
}

struct Shoulder {
  Vector3d p;           // [m] from its place in the T-pose
  Matrix3d R_clavicle;  // in the upper back
};

Shoulder shoulderOf(const Skeleton& skeleton, const ArmAngles& arm) {
  const Matrix3d R = clavicleRotation(arm);
  const Vector3d& humerus = skeleton.offset[static_cast<std::size_t>(Bone::LeftHumerus)];
  return {R * humerus - humerus, R};
}

// The humerus' DoFs for an upper arm along u with the elbow bending away from e (unit, both in the upper back's frame).
void setHumerus(const Matrix3d& R_clavicle, const Vector3d& u, const Vector3d& e, ArmAngles& arm) {
  const Vector3d bend = -(e - e.dot(u) * u).normalized();
  Matrix3d R;
  R << u, bend.cross(u), bend;
  Pose q = Pose::Zero();
  setLocalRotation(Bone::LeftHumerus, R_clavicle.transpose() * R, q);
  arm.twist = q[kLhumerusRx];
  arm.swing_y = q[kLhumerusRy];
  arm.swing_z = q[kLhumerusRz];
}

// How far [rad^2] the humerus is out of its limits.
double limitViolation(const ArmAngles& arm) {
  const auto& limits = jointLimits();
  double sum = 0;
  const auto add = [&](double value, int dof) {
    const double over =
        std::max({0.0, value - limits.upper[dof] + kLimitMargin, limits.lower[dof] + kLimitMargin - value});
    sum += over * over;
  };
  add(arm.twist, kLhumerusRx);
  add(arm.swing_y, kLhumerusRy);
  add(arm.swing_z, kLhumerusRz);
  return sum;
}

void clampHumerus(ArmAngles& arm) {
  const auto& limits = jointLimits();
  const auto clamp = [&](double& value, int dof) {
    value = std::clamp(value, limits.lower[dof] + kLimitMargin, limits.upper[dof] - kLimitMargin);
  };
  clamp(arm.twist, kLhumerusRx);
  clamp(arm.swing_y, kLhumerusRy);
  clamp(arm.swing_z, kLhumerusRz);
}

// The elbow's turn that costs least: near 0, within the limits. A scan with a parabola through the best three.
template <typename Cost>
double bestTurn(const Cost& cost) {
  constexpr int kSteps = 16;
  constexpr double kStep = 0.1;
  std::array<double, 2 * kSteps + 1> costs;
  for (std::size_t i = 0; i < costs.size(); ++i) costs[i] = cost((static_cast<int>(i) - kSteps) * kStep);
  const auto best = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
  double turn = (static_cast<double>(best) - kSteps) * kStep;
  if (best > 0 && best + 1 < costs.size()) {
    const double curvature = costs[best - 1] - 2 * costs[best] + costs[best + 1];
    if (curvature > 1e-9) turn += 0.5 * kStep * (costs[best - 1] - costs[best + 1]) / curvature;
  }
  return turn;
}

}  // namespace

ArmAngles reachArm(const Skeleton& skeleton, const HandTarget& target) {
  const double a = skeleton.lengths.upper_arm;
  const double b = skeleton.lengths.lower_arm;
  const Vector3d wrist(target.out, target.up, target.forward);
  ArmAngles arm;
  followClavicle(wrist.normalized(), std::min(1.0, wrist.norm() / (a + b)), arm);
  const Shoulder shoulder = shoulderOf(skeleton, arm);
  const Vector3d line = wrist - shoulder.p;
  const auto reach = [&](double flexion) { return std::sqrt(a * a + b * b + 2 * a * b * std::cos(flexion)); };
  const double d = std::clamp(line.norm(), reach(kMaxElbowFlexion), reach(kMinElbowFlexion));
  const Vector3d hand = line.normalized();
  const double at_shoulder = std::acos(std::clamp((a * a + d * d - b * b) / (2 * a * d), -1.0, 1.0));
  arm.elbow = -std::acos(std::clamp((d * d - a * a - b * b) / (2 * a * b), -1.0, 1.0));
  const Vector3d relaxed = relaxedElbow(hand);
  const auto place = [&](double turn) {
    const Vector3d e = Eigen::AngleAxisd(target.elbow + turn, hand) * relaxed;
    const Vector3d u = std::cos(at_shoulder) * hand + std::sin(at_shoulder) * e;
    setHumerus(shoulder.R_clavicle, u, e, arm);
    return 0.05 * turn * turn + limitViolation(arm);
  };
  place(0.0);
  if (limitViolation(arm) > 0) place(bestTurn(place));
  clampHumerus(arm);
  return arm;
}

ArmAngles swingArm(double flexion, double abduction, double elbow_flexion) {
  ArmAngles arm;
  arm.clavicle_z = -0.04;
  arm.clavicle_y = -0.08 * flexion;
  const Vector3d u(std::sin(abduction), -std::cos(abduction) * std::cos(flexion),
                   std::cos(abduction) * std::sin(flexion));
  setHumerus(clavicleRotation(arm), u, Vector3d(0.35, -0.3 * std::sin(flexion), -1.0).normalized(), arm);
  arm.elbow = -std::max(elbow_flexion, kMinElbowFlexion);
  clampHumerus(arm);
  return arm;
}

Vector3d wristOf(const Skeleton& skeleton, const ArmAngles& arm) {
  const Shoulder shoulder = shoulderOf(skeleton, arm);
  Pose q = Pose::Zero();
  q[kLhumerusRx] = arm.twist;
  q[kLhumerusRy] = arm.swing_y;
  q[kLhumerusRz] = arm.swing_z;
  q[kLradiusRy] = arm.elbow;
  const Matrix3d R_humerus = shoulder.R_clavicle * localRotation(Bone::LeftHumerus, q);
  const Vector3d& elbow = skeleton.offset[static_cast<std::size_t>(Bone::LeftRadius)];
  return shoulder.p + R_humerus * (elbow + localRotation(Bone::LeftRadius, q) * skeleton.left_wrist);
}

}  // namespace depthmocap

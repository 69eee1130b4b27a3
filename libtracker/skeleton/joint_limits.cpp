#include "libtracker/skeleton/joint_limits.h"

#include <algorithm>
#include <numbers>

#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr double kUnlimited = 1e9;

struct RangeDeg {
  Dof dof;
  double lower;
  double upper;
};

// Ranges of the right side and the middle of the body [deg], generous ends of the clinical ranges (Norkin and White
// 2016), so that they exclude impossible poses and nothing that dancers do.
constexpr RangeDeg kRanges[] = {
    {kUpperbackRx, -45, 90}, {kUpperbackRy, -60, 60},  {kUpperbackRz, -50, 50}, {kRclavicleRy, -35, 45},
    {kRclavicleRz, -50, 25}, {kRhumerusRx, -110, 110}, {kRhumerusRy, -70, 150}, {kRhumerusRz, -120, 120},
    {kRradiusRy, -5, 155},   {kNeckRx, -60, 70},       {kNeckRz, -50, 50},      {kHeadRy, -85, 85},
    {kRfemurRx, -150, 60},   {kRfemurRy, -60, 60},     {kRfemurRz, -100, 50},   {kRtibiaRx, -8, 160},
    {kRfootRx, -50, 75},     {kRfootRy, -50, 50},
};

JointLimits makeLimits() {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  JointLimits limits;
  limits.lower.setConstant(-kUnlimited);
  limits.upper.setConstant(kUnlimited);
  Pose right_lower = limits.lower;
  Pose right_upper = limits.upper;
  for (const RangeDeg& range : kRanges) {
    right_lower[range.dof] = range.lower * kRadPerDeg;
    right_upper[range.dof] = range.upper * kRadPerDeg;
  }
  // The mirror image gives the left side; where mirroring negates a DoF its ends change places.
  const Pose a = mirroredPose(right_lower);
  const Pose b = mirroredPose(right_upper);
  for (int i = 0; i < kDofCount; ++i) {
    const bool given = right_upper[i] < kUnlimited;
    limits.lower[i] = given ? right_lower[i] : std::min(a[i], b[i]);
    limits.upper[i] = given ? right_upper[i] : std::max(a[i], b[i]);
  }
  return limits;
}

}  // namespace

const JointLimits& jointLimits() {
  static const JointLimits limits = makeLimits();
  return limits;
}

Pose clampedToLimits(const Pose& q) {
  return q.cwiseMax(jointLimits().lower).cwiseMin(jointLimits().upper);
}

}  // namespace depthmocap

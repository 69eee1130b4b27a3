#include "libtracker/motion/retarget.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <ceres/tiny_solver.h>

#include "libtracker/core/check.h"
#include "libtracker/motion/rest_calibration.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

// Weight of a radian beyond a joint limit against a metre of distance of a joint.
constexpr double kLimitWeight_m = 0.10;
// Weight of a radian of change from the frame before against a metre of distance of a joint.
constexpr double kSmoothWeight_m = 0.003;

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Weight of each joint in the fit: the trunk's joints depend on how the source divides its spine, the limbs' do not.
constexpr std::array<double, kJointCount> kJointWeights = {0.5, 0.3, 0.5, 0.7, 0.8, 1.0, 1.0, 0.8, 1.0,
                                                           1.0, 1.0, 1.0, 1.0, 0.7, 1.0, 1.0, 1.0, 0.7};
constexpr int kBodyDofs = kDofCount - kFirstBodyDof;
constexpr int kAxisCount = static_cast<int>(kFitAxes.size());
constexpr int kJointRows = 3 * kJointCount;
constexpr int kAxisRows = 3 * kAxisCount;

// The residuals of one frame for ceres::TinySolver.
class FrameFit {
 public:
  using Scalar = double;
  enum { NUM_RESIDUALS = kJointRows + kAxisRows + 2 * kBodyDofs, NUM_PARAMETERS = kDofCount };

  explicit FrameFit(const Skeleton& skeleton) : skeleton_(skeleton), points_(jointPoints(skeleton)) {}

  FitTargets targets;
  Pose previous = Pose::Zero();
  bool smooth = false;

  bool operator()(const double* parameters, double* residuals, double* jacobian) const {
    const Eigen::Map<const Pose> q(parameters);
    Eigen::Map<Residuals> r(residuals);
    fk_.update(skeleton_, q);
    jointRows(r);
    axisRows(r);
    dofRows(q, r);
    if (jacobian != nullptr) differentiate(q, jacobian);
    return true;
  }

  [[nodiscard]] JointPositions joints(const Pose& q) const {
    fk_.update(skeleton_, q);
    JointPositions p;
    for (int j = 0; j < kJointCount; ++j) p.col(j) = fk_.position(points_[static_cast<std::size_t>(j)]);
    return p;
  }

 private:
  using Residuals = Eigen::Matrix<double, NUM_RESIDUALS, 1>;

  // A unit vector of a bone is the end of a lever seen from the bone's origin.
  static BonePoint leverEnd(const BoneAxis& axis) { return {axis.bone, axis.lever_m * Vector3d::Unit(axis.axis)}; }

  void jointRows(Eigen::Map<Residuals>& r) const {
    for (int j = 0; j < kJointCount; ++j) {
      const auto i = static_cast<std::size_t>(j);
      r.segment<3>(3 * j) = kJointWeights[i] * (fk_.position(points_[i]) - targets.joints.col(j));
    }
  }

  void axisRows(Eigen::Map<Residuals>& r) const {
    for (int a = 0; a < kAxisCount; ++a) {
      const auto i = static_cast<std::size_t>(a);
      const BoneAxis& axis = kFitAxes[i];
      r.segment<3>(kJointRows + 3 * a) = axis.lever_m * (fk_.R_world_bone(axis.bone).col(axis.axis) - targets.axes[i]);
    }
  }

  void dofRows(const Pose& q, Eigen::Map<Residuals>& r) const {
    const JointLimits& limits = jointLimits();
    for (int i = 0; i < kBodyDofs; ++i) {
      const int dof = kFirstBodyDof + i;
      const double beyond = q[dof] - std::clamp(q[dof], limits.lower[dof], limits.upper[dof]);
      r[kJointRows + kAxisRows + i] = kLimitWeight_m * beyond;
      r[kJointRows + kAxisRows + kBodyDofs + i] = smooth ? kSmoothWeight_m * (q[dof] - previous[dof]) : 0.0;
    }
  }

  void differentiate(const Pose& q, double* jacobian) const {
    Eigen::Map<Eigen::Matrix<double, NUM_RESIDUALS, NUM_PARAMETERS>> J(jacobian);
    J.setZero();
    PointJacobian point;
    PointJacobian origin;
    for (int j = 0; j < kJointCount; ++j) {
      const auto i = static_cast<std::size_t>(j);
      fk_.jacobian(points_[i], point);
      J.middleRows<3>(3 * j) = kJointWeights[i] * point;
    }
    for (int a = 0; a < kAxisCount; ++a) {
      const BoneAxis& axis = kFitAxes[static_cast<std::size_t>(a)];
      fk_.jacobian(leverEnd(axis), point);
      fk_.jacobian({axis.bone, Vector3d::Zero()}, origin);
      J.middleRows<3>(kJointRows + 3 * a) = point - origin;
    }
    const JointLimits& limits = jointLimits();
    for (int i = 0; i < kBodyDofs; ++i) {
      const int dof = kFirstBodyDof + i;
      const bool beyond = q[dof] < limits.lower[dof] || q[dof] > limits.upper[dof];
      J(kJointRows + kAxisRows + i, dof) = beyond ? kLimitWeight_m : 0.0;
      J(kJointRows + kAxisRows + kBodyDofs + i, dof) = smooth ? kSmoothWeight_m : 0.0;
    }
  }

  const Skeleton& skeleton_;
  std::array<BonePoint, kJointCount> points_;
  mutable ForwardKinematics fk_;
};

Vector3d joint(const FitTargets& t, Joint j) {
  return t.joints.col(static_cast<int>(j));
}

// A rotation from one exact axis and one approximate one; x, y, z = exact, near, their normal in the order given.
Matrix3d frameFrom(int exact_axis, const Vector3d& exact, int near_axis, const Vector3d& near) {
  Matrix3d R;
  const Vector3d e = exact.normalized();
  const Vector3d n = (near - e * e.dot(near)).normalized();
  const int third = 3 - exact_axis - near_axis;
  R.col(exact_axis) = e;
  R.col(near_axis) = n;
  R.col(third) = (near_axis - exact_axis + 3) % 3 == 1 ? e.cross(n) : n.cross(e);
  return R;
}

// A start for the fit from directions alone, for the first frame and where the frame before leads astray.
Pose poseFromDirections(const FitTargets& t, const Skeleton& skeleton) {
  Pose q = Pose::Zero();
  ForwardKinematics fk;
  const auto set = [&](Bone bone, const Matrix3d& R_world) {
    fk.update(skeleton, q);
    const int parent = kBoneParents[static_cast<std::size_t>(bone)];
    const Matrix3d R_world_parent = parent < 0 ? Matrix3d::Identity() : fk.R_world_bone(static_cast<Bone>(parent));
    setLocalRotation(bone, R_world_parent.transpose() * R_world, q);
  };
  q.head<3>() = joint(t, Joint::Pelvis);
  set(Bone::Root, frameFrom(0, joint(t, Joint::LeftHip) - joint(t, Joint::RightHip), 2, t.axes[0]));
  set(Bone::UpperBack, frameFrom(1, joint(t, Joint::Neck) - joint(t, Joint::Spine), 0, t.axes[1]));
  const auto arm = [&](Bone humerus, Dof elbow, Joint shoulder, const Vector3d& axis, double side) {
    const int s = static_cast<int>(shoulder);
    set(humerus, frameFrom(0, side * (t.joints.col(s + 1) - t.joints.col(s)), 1, axis));
    fk.update(skeleton, q);
    const Vector3d f = fk.R_world_bone(humerus).transpose() * (t.joints.col(s + 2) - t.joints.col(s + 1));
    q[elbow] = std::atan2(-side * f.z(), side * f.x());
  };
  arm(Bone::RightHumerus, kRradiusRy, Joint::RightShoulder, t.axes[3], -1);
  arm(Bone::LeftHumerus, kLradiusRy, Joint::LeftShoulder, t.axes[4], 1);
  const auto leg = [&](Bone femur, Dof knee, Joint hip, const Vector3d& axis) {
    const int h = static_cast<int>(hip);
    set(femur, frameFrom(1, t.joints.col(h) - t.joints.col(h + 1), 0, axis));
    fk.update(skeleton, q);
    const Vector3d f = fk.R_world_bone(femur).transpose() * (t.joints.col(h + 2) - t.joints.col(h + 1));
    q[knee] = std::atan2(-f.z(), -f.y());
  };
  leg(Bone::RightFemur, kRtibiaRx, Joint::RightHip, t.axes[5]);
  leg(Bone::LeftFemur, kLtibiaRx, Joint::LeftHip, t.axes[6]);
  return q;
}

// The same rotation of the root with its tilt within pi, heading near to the one before.
void canonicaliseRoot(Pose& q, double heading_before) {
  if (Eigen::Vector2d(q[kRootRx], q[kRootRz]).norm() > std::numbers::pi) {
    const Matrix3d R = localRotation(Bone::Root, q);
    setLocalRotation(Bone::Root, R, q);
  }
  constexpr double kTurn = 2.0 * std::numbers::pi;
  q[kRootRy] -= kTurn * std::round((q[kRootRy] - heading_before) / kTurn);
}

bool clearlyBeyondLimits(const Pose& q) {
  constexpr double kClearly = 0.35;  // [rad] performers go a little beyond the limits of most people
  const JointLimits& limits = jointLimits();
  const auto over = (q - limits.upper).cwiseMax(limits.lower - q).tail<kBodyDofs>();
  return over.maxCoeff() > kClearly;
}

class Fitter {
 public:
  Fitter(const RestCalibration& calibration, const Skeleton& skeleton)
      : calibration_(calibration), skeleton_(skeleton), fit_(skeleton) {
    solver_.options.max_num_iterations = 60;
    solver_.options.function_tolerance = 1e-7;
    solver_.options.parameter_tolerance = 1e-7;
  }

  // q of the next frame, and the distance of each joint.
  Pose next(const GlobalFrame& frame, Eigen::Matrix<double, kJointCount, 1>& distance) {
    calibration_.targets(frame, fit_.targets);
    Pose q = fit_.previous;
    double cost = fit_.smooth ? solve(q) : 0.0;
    if (!fit_.smooth || cost > kDoubtfulCost) {
      Pose fresh = poseFromDirections(fit_.targets, skeleton_);
      const bool first = !fit_.smooth;
      fit_.smooth = false;
      const double fresh_cost = solve(fresh);
      fit_.smooth = true;
      if (first || fresh_cost < kClearlyBetter * cost) q = fresh;
    }
    canonicaliseRoot(q, fit_.previous[kRootRy]);
    // What shrinks from frame to frame towards zero ends in denormal numbers, with which the machine is slow.
    q = (q.array().abs() < kNothing).select(0.0, q);
    fit_.previous = q;
    distance = (fit_.joints(q) - fit_.targets.joints).colwise().norm();
    return q;
  }
  // The joints that the last pose was fitted to [m].
  [[nodiscard]] const JointPositions& targets() const { return fit_.targets.joints; }

 private:
  static constexpr double kDoubtfulCost = 8e-4;  // [m^2] some joint or axis is off by centimetres
  static constexpr double kClearlyBetter = 0.5;
  static constexpr double kNothing = 1e-12;

  double solve(Pose& q) {
    const auto& summary = solver_.Solve(fit_, &q);
    return summary.final_cost;
  }

  const RestCalibration& calibration_;
  const Skeleton& skeleton_;
  FrameFit fit_;
  ceres::TinySolver<FrameFit> solver_;
};

}  // namespace

double RetargetResiduals::mean() const {
  double sum = 0;
  for (const double m : mean_m) sum += m;
  return sum / kJointCount;
}

RetargetResult retarget(const SourceMotion& motion, const NamedBones& named, double metres_per_unit,
                        const std::string& where) {
  DMC_CHECK(!motion.frames.empty() && metres_per_unit > 0);
  const RestCalibration calibration(motion, named, metres_per_unit, where);
  RetargetResult result;
  result.warnings = motion.warnings;
  result.clip.fps = motion.fps;
  result.clip.lengths = calibration.lengths();
  result.clip.poses.reserve(motion.frames.size());
  const Skeleton skeleton = makeSkeleton(calibration.lengths());
  Fitter fitter(calibration, skeleton);
  GlobalFrame global;
  Eigen::Matrix<double, kJointCount, 1> distance;
  for (const MotionFrame& frame : motion.frames) {
    globalFrame(motion.bones, frame, global);
    result.clip.poses.push_back(fitter.next(global, distance));
    result.source_joints.push_back(fitter.targets());
    if (clearlyBeyondLimits(result.clip.poses.back()))
      result.beyond_limits += 1.0 / static_cast<double>(motion.frames.size());
    for (int j = 0; j < kJointCount; ++j) {
      const auto i = static_cast<std::size_t>(j);
      result.residuals.mean_m[i] += distance[j] / static_cast<double>(motion.frames.size());
      result.residuals.max_m[i] = std::max(result.residuals.max_m[i], distance[j]);
    }
  }
  return result;
}

}  // namespace depthmocap

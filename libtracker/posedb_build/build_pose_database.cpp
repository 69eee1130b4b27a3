#include "libtracker/posedb_build/build_pose_database.h"

#include <array>
#include <cmath>
#include <string>
#include <unordered_map>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/core/parallel.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

using Joints = Eigen::Matrix<float, 3, kJointCount>;

// Joints in the order in which two poses are compared: those that move most decide first.
constexpr std::array<Joint, kJointCount> kComparisonOrder = {
    Joint::RightWrist,    Joint::LeftAnkle, Joint::RightAnkle, Joint::LeftElbow, Joint::RightElbow, Joint::LeftKnee,
    Joint::RightKnee,     Joint::LeftToe,   Joint::RightToe,   Joint::Head,      Joint::LeftWrist,  Joint::LeftShoulder,
    Joint::RightShoulder, Joint::Neck,      Joint::Spine,      Joint::LeftHip,   Joint::RightHip,   Joint::Pelvis};

// The kept poses' joints, found by the cell of the left wrist: with cells as large as the threshold a pose nearer than
// it lies in one of 27 cells.
class KeptPoses {
 public:
  explicit KeptPoses(double threshold_m)
      : threshold_(static_cast<float>(threshold_m)), cell_(std::max(threshold_, 1e-4F)) {}

  // Keeps the pose if it is new; false if it is not.
  bool addIfNew(const Joints& joints) {
    const Eigen::Vector3i cell = cellOf(joints);
    if (threshold_ > 0 && isKnown(joints, cell)) return false;
    cells_[keyOf(cell)].push_back(static_cast<std::uint32_t>(kept_.size()));
    kept_.push_back(joints);
    return true;
  }

 private:
  [[nodiscard]] Eigen::Vector3i cellOf(const Joints& joints) const {
    const Eigen::Vector3f wrist = joints.col(static_cast<int>(Joint::LeftWrist));
    return (wrist / cell_).array().floor().matrix().cast<int>();
  }

  // Coordinates within +-2^20 cells are distinct; others only share a cell, which costs time and nothing else.
  static std::uint64_t keyOf(const Eigen::Vector3i& cell) {
    constexpr std::uint64_t kMask = (1U << 21U) - 1U;
    const auto part = [](int c) { return static_cast<std::uint64_t>(static_cast<std::int64_t>(c)) & kMask; };
    return part(cell.x()) | part(cell.y()) << 21U | part(cell.z()) << 42U;
  }

  [[nodiscard]] bool isKnown(const Joints& joints, const Eigen::Vector3i& cell) const {
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find(keyOf(cell + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
      if (found == cells_.end()) continue;
      for (const std::uint32_t other : found->second) {
        if (isNear(joints, kept_[other])) return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool isNear(const Joints& a, const Joints& b) const {
    for (const Joint joint : kComparisonOrder) {
      const int j = static_cast<int>(joint);
      if ((a.col(j) - b.col(j)).squaredNorm() > threshold_ * threshold_) return false;
    }
    return true;
  }

  float threshold_;
  float cell_;
  std::vector<Joints> kept_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

bool isBeyondLimits(const Pose& q, double tolerance) {
  return (q - clampedToLimits(q)).cwiseAbs().maxCoeff() > tolerance;
}

Pose withoutPlace(Pose q) {
  q[kRootTx] = q[kRootTy] = q[kRootTz] = q[kRootRy] = 0;
  return q;
}

class Builder {
 public:
  explicit Builder(const PoseDatabaseConfig& config)
      : config_(config), skeleton_(makeSkeleton(BoneLengths{})), kept_(config.threshold_m) {}

  void add(const std::string& name, const std::vector<Pose>& poses) {
    std::vector<Joints> joints(poses.size());
    parallelFor(config_.threads, poses.size(),
                [&](std::size_t i) { joints[i] = jointPositions(skeleton_, poses[i]).cast<float>(); });
    PoseDatabase& database = result_.database;
    PoseDatabase::Source source{name, static_cast<std::uint32_t>(database.size()), 0};
    for (std::size_t i = 0; i < poses.size(); ++i) {
      DMC_CHECK(poses[i].allFinite());
      ++result_.counts.frames;
      if (isBeyondLimits(poses[i], config_.beyond_limits_rad)) {
        ++result_.counts.beyond_limits;
      } else if (kept_.addIfNew(joints[i])) {
        database.poses.push_back(poses[i].cast<float>());
        ++source.count;
      }
    }
    result_.counts.kept = database.size();
    database.sources.push_back(source);
  }

  PoseDatabaseResult take() { return std::move(result_); }

 private:
  PoseDatabaseConfig config_;
  Skeleton skeleton_;
  KeptPoses kept_;
  PoseDatabaseResult result_;
};

}  // namespace

void PoseDatabaseConfig::validate() const {
  const char* name = "PoseDatabaseConfig";
  checkConfig(threshold_m >= 0, name, "threshold_m", threshold_m, "at least 0");
  checkConfig(beyond_limits_rad >= 0, name, "beyond_limits_rad", beyond_limits_rad, "at least 0");
  checkConfig(threads >= 1, name, "threads", threads, "at least 1");
}

PoseDatabaseResult buildPoseDatabase(const std::vector<MotionClip>& clips, const PoseDatabaseConfig& config) {
  config.validate();
  Builder builder(config);
  std::vector<Pose> poses;
  for (const MotionClip& clip : clips) {
    poses.clear();
    for (const Pose& q : clip.poses) poses.push_back(withoutPlace(q));
    builder.add(clip.name, poses);
    if (!config.mirror) continue;
    for (Pose& q : poses) q = mirroredPose(q);
    builder.add(clip.name + ":mirrored", poses);
  }
  return builder.take();
}

}  // namespace depthmocap

#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "libtracker/core/random.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/skeleton/motion_clip.h"

namespace depthmocap {

// Poses to render, free of place and heading, without near duplicates.
struct PosePool {
  using StoredPose = Eigen::Matrix<float, kDofCount, 1>;
  // Tilt of the trunk, hips and knees in coarse steps; arms do not count.
  using Posture = std::array<std::int8_t, 9>;
  std::vector<StoredPose> poses;
  std::string description;  // changes with the poses
  // The poses of each posture, and where a posture stands among them. Half of all captured poses share 34 postures of
  // 5,594: people walk and stand.
  std::vector<std::vector<std::uint32_t>> by_posture;
  std::map<Posture, std::size_t> posture_index;

  void add(const StoredPose& q);
};

// What is left out of training, for measuring: motions by name; with none named, every motion whose name falls into a
// tenth of all by its hash.
class HeldOutMotions {
 public:
  explicit HeldOutMotions(std::vector<std::string> names = {}) : names_(std::move(names)) {}
  [[nodiscard]] bool contains(std::string_view motion) const;

 private:
  std::vector<std::string> names_;
};

enum class PoseUse { Train, Validate };

// Adds the poses of a database or of motions that are for this use. Of a motion's poses those are kept that differ from
// the last one kept by min_change [rad] in some angle.
void addPoses(const PoseDatabase& database, const HeldOutMotions& held_out, PoseUse use, double min_change,
              PosePool& pool);
void addPoses(const std::vector<MotionClip>& motions, const HeldOutMotions& held_out, PoseUse use, double min_change,
              PosePool& pool);

// How a pose of the pool is varied before it is rendered.
struct PoseVariation {
  double mix_share = 0.35;  // [0, 1] of the poses whose arms come from another pose, each arm by itself
  // [0, 1] of the arms that hang at the side instead, hand on the thigh: people stand so, captured actors seldom do.
  double hang_share = 0.15;
  double jitter = 0.06;  // [rad] standard deviation of every angle of the body
  // [0, 1] of the poses drawn from a posture chosen uniformly, so that bending, squatting and kneeling are as frequent
  // as walking; the others uniformly from all poses
  double posture_share = 0;
};

// A random pose of the pool (not empty), varied, within the joint limits.
Pose drawPose(const PosePool& pool, const PoseVariation& variation, Random& random);

// A random T-pose as people stand it: arms not quite level, elbows not quite straight.
Pose drawTPose(Random& random);

}  // namespace depthmocap

#include "forest/train/pose_pool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "libtracker/core/check.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

using StoredPose = PosePool::StoredPose;

// FNV-1a
std::uint32_t hashOf(std::string_view text) {
  std::uint32_t hash = 0x811C9DC5U;
  for (const char c : text) hash = (hash ^ static_cast<std::uint8_t>(c)) * 0x01000193U;
  return hash;
}

constexpr float kPostureStep = 0.5F;  // [rad]
constexpr std::array<int, std::tuple_size_v<PosePool::Posture>> kPostureDofs = {
    kRootRx, kRootRz, kUpperbackRx, kRfemurRx, kRfemurRz, kLfemurRx, kLfemurRz, kRtibiaRx, kLtibiaRx};

// Where the actor stands and looks is drawn for every picture.
StoredPose withoutPlace(StoredPose q) {
  for (const int dof : {kRootTx, kRootTy, kRootTz, kRootRy}) q[dof] = 0;
  return q;
}

class Thinning {
 public:
  Thinning(double min_change, PosePool& pool) : min_change_(static_cast<float>(min_change)), pool_(pool) {}
  void add(const StoredPose& q) {
    if (!empty_ && (q - last_).cwiseAbs().maxCoeff() < min_change_) return;
    last_ = q;
    empty_ = false;
    pool_.add(q);
  }

 private:
  float min_change_;
  PosePool& pool_;
  StoredPose last_ = StoredPose::Zero();
  bool empty_ = true;
};

void describe(const std::string& origin, std::size_t poses_before, PosePool& pool) {
  pool.description += (pool.description.empty() ? "" : " + ") + std::to_string(pool.poses.size() - poses_before) +
                      " poses of " + origin;
}

constexpr std::array<int, 6> kRightArm = {kRclavicleRy, kRclavicleRz, kRhumerusRx,
                                          kRhumerusRy,  kRhumerusRz,  kRradiusRy};
constexpr std::array<int, 6> kLeftArm = {kLclavicleRy, kLclavicleRz, kLhumerusRx, kLhumerusRy, kLhumerusRz, kLradiusRy};

// The right arm of an actor who stands at ease, the hand beside, before or behind the thigh.
void hangRightArm(Random& random, Pose& q) {
  for (const int dof : kRightArm) q[dof] = 0;
  q[kRhumerusRz] = 1.42 + 0.13 * random.normal();
  q[kRhumerusRy] = 0.05 + 0.18 * random.normal();
  q[kRhumerusRx] = 0.4 * random.normal();
  q[kRradiusRy] = std::abs(0.35 * random.normal());
}

}  // namespace

void PosePool::add(const StoredPose& q) {
  Posture posture{};
  for (std::size_t i = 0; i < posture.size(); ++i) {
    posture[i] = static_cast<std::int8_t>(std::lround(q[kPostureDofs[i]] / kPostureStep));
  }
  const auto [place, is_new] = posture_index.try_emplace(posture, by_posture.size());
  if (is_new) by_posture.emplace_back();
  by_posture[place->second].push_back(static_cast<std::uint32_t>(poses.size()));
  poses.push_back(q);
}

bool HeldOutMotions::contains(std::string_view motion) const {
  motion = motion.substr(0, motion.find(':'));  // "16_15:mirrored" is 16_15
  if (names_.empty()) return hashOf(motion) % 10 == 0;
  return std::find(names_.begin(), names_.end(), motion) != names_.end();
}

void addPoses(const PoseDatabase& database, const HeldOutMotions& held_out, PoseUse use, double min_change,
              PosePool& pool) {
  const std::size_t before = pool.poses.size();
  for (const auto& source : database.sources) {
    if (held_out.contains(source.name) != (use == PoseUse::Validate)) continue;
    Thinning thinning(min_change, pool);
    for (std::uint32_t i = 0; i < source.count; ++i) thinning.add(withoutPlace(database.poses[source.first + i]));
  }
  describe(database.origin, before, pool);
}

void addPoses(const std::vector<MotionClip>& motions, const HeldOutMotions& held_out, PoseUse use, double min_change,
              PosePool& pool) {
  const std::size_t before = pool.poses.size();
  for (const MotionClip& motion : motions) {
    if (held_out.contains(motion.name) != (use == PoseUse::Validate)) continue;
    Thinning thinning(min_change, pool);
    for (const Pose& q : motion.poses) thinning.add(withoutPlace(q.cast<float>()));
  }
  describe("procedural motions", before, pool);
}

Pose drawPose(const PosePool& pool, const PoseVariation& variation, Random& random) {
  DMC_CHECK(!pool.poses.empty());
  const auto any = [&]() -> const StoredPose& {
    return pool.poses[random.below(static_cast<std::uint32_t>(pool.poses.size()))];
  };
  const auto anyPosture = [&]() -> const StoredPose& {
    DMC_CHECK(!pool.by_posture.empty());
    const auto& alike = pool.by_posture[random.below(static_cast<std::uint32_t>(pool.by_posture.size()))];
    return pool.poses[alike[random.below(static_cast<std::uint32_t>(alike.size()))]];
  };
  // No number is drawn where it decides nothing: the pictures of a seed stay what they were.
  const bool by_posture = variation.posture_share > 0 && random.uniform() < variation.posture_share;
  StoredPose q = by_posture ? anyPosture() : any();
  if (random.uniform() < variation.mix_share) {
    const StoredPose& right = any();
    const StoredPose& left = any();
    for (const int dof : kRightArm) q[dof] = right[dof];
    for (const int dof : kLeftArm) q[dof] = left[dof];
  }
  Pose result = q.cast<double>();
  for (int side = 0; side < 2; ++side) {
    if (random.uniform() < variation.hang_share) hangRightArm(random, result);
    result = mirroredPose(result);
  }
  for (int dof = kFirstBodyDof; dof < kDofCount; ++dof) result[dof] += variation.jitter * random.normal();
  return clampedToLimits(result);
}

Pose drawTPose(Random& random) {
  Pose q = Pose::Zero();
  const auto vary = [&](int dof, double mean, double deviation) { q[dof] = mean + deviation * random.normal(); };
  for (int dof = kFirstBodyDof; dof < kDofCount; ++dof) vary(dof, 0, 0.05);
  for (const int dof : {kRootRx, kRootRz}) vary(dof, 0, 0.04);
  // Arms a little down and forward; both mirror images of one another on average.
  const double level = 0.10 * random.normal();
  vary(kRhumerusRz, 0.03 + level, 0.08);
  vary(kLhumerusRz, -0.03 - level, 0.08);
  for (const int dof : {kRhumerusRy, kLhumerusRy}) vary(dof, 0, 0.12);
  for (const int dof : {kRhumerusRx, kLhumerusRx}) vary(dof, 0, 0.5);
  q[kRradiusRy] = std::abs(0.15 * random.normal());
  q[kLradiusRy] = -std::abs(0.15 * random.normal());
  const double stance = std::abs(0.12 * random.normal());
  vary(kRfemurRz, -stance, 0.03);
  vary(kLfemurRz, stance, 0.03);
  return clampedToLimits(q);
}

}  // namespace depthmocap

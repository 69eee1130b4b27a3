#include <array>
#include <cmath>
#include <optional>

#include "libtracker/core/check.h"
#include "libtracker/ik/classic_solvers.h"
#include "libtracker/ik/closest_so_far.h"
#include "libtracker/ik/target_term.h"
#include "libtracker/posedb/best_rotation.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kMaxIterations = 100;
constexpr double kStay = 1e-3;   // weight of a piece's present place where its wanted points leave it open
constexpr double kBeyond = 0.1;  // weight of the point after a bone's end, for the twist about the bone

// The nodes of the tree: joints, and where the clavicles begin.
constexpr int kRightClavicleNode = kJointCount;
constexpr int kLeftClavicleNode = kJointCount + 1;
constexpr int kNodeCount = kJointCount + 2;
constexpr int node(Joint joint) {
  return static_cast<int>(joint);
}

using Places = std::array<std::optional<Vector3d>, kNodeCount>;

// A limb from its tip to where it begins on a rigid piece.
struct Limb {
  std::array<int, 4> nodes;
  int count;
};
constexpr std::array<Limb, 5> kLimbs = {{
    {{node(Joint::Head), node(Joint::Neck), 0, 0}, 2},
    {{node(Joint::LeftWrist), node(Joint::LeftElbow), node(Joint::LeftShoulder), kLeftClavicleNode}, 4},
    {{node(Joint::RightWrist), node(Joint::RightElbow), node(Joint::RightShoulder), kRightClavicleNode}, 4},
    {{node(Joint::LeftToe), node(Joint::LeftAnkle), node(Joint::LeftKnee), node(Joint::LeftHip)}, 4},
    {{node(Joint::RightToe), node(Joint::RightAnkle), node(Joint::RightKnee), node(Joint::RightHip)}, 4},
}};
constexpr std::array<int, 4> kGirdle = {node(Joint::Spine), node(Joint::Neck), kRightClavicleNode, kLeftClavicleNode};
constexpr std::array<int, 4> kPelvis = {node(Joint::Pelvis), node(Joint::Spine), node(Joint::LeftHip),
                                        node(Joint::RightHip)};

// Which nodes a bone is aimed by: its end, and what comes after that.
struct Aim {
  Bone bone;
  int end;
  int beyond;  // -1: nothing
};
constexpr std::array<Aim, 11> kAims = {{
    {Bone::Neck, node(Joint::Head), -1},
    {Bone::RightClavicle, node(Joint::RightShoulder), -1},
    {Bone::LeftClavicle, node(Joint::LeftShoulder), -1},
    {Bone::RightHumerus, node(Joint::RightElbow), node(Joint::RightWrist)},
    {Bone::LeftHumerus, node(Joint::LeftElbow), node(Joint::LeftWrist)},
    {Bone::RightRadius, node(Joint::RightWrist), -1},
    {Bone::LeftRadius, node(Joint::LeftWrist), -1},
    {Bone::RightFemur, node(Joint::RightKnee), node(Joint::RightAnkle)},
    {Bone::LeftFemur, node(Joint::LeftKnee), node(Joint::LeftAnkle)},
    {Bone::RightTibia, node(Joint::RightAnkle), node(Joint::RightToe)},
    {Bone::LeftTibia, node(Joint::LeftAnkle), node(Joint::LeftToe)},
}};
constexpr std::array<Aim, 2> kFootAims = {
    {{Bone::RightFoot, node(Joint::RightToe), -1}, {Bone::LeftFoot, node(Joint::LeftToe), -1}}};

class Fabrik {
 public:
  Fabrik(const Skeleton& skeleton, const JointTargets& targets, const Pose& start)
      : skeleton_(skeleton), targets_(targets), points_(jointPoints(skeleton)), q_(start) {
    fk_.update(skeleton_, q_);
  }

  const Pose& iterate() {
    reachInwards();
    placePelvis();
    turnTo(Bone::UpperBack, kGirdle);
    for (const Aim& aim : kAims) turnTo(aim.bone, std::array{aim.end, aim.beyond});
    for (const Aim& aim : kFootAims) turnTo(aim.bone, std::array{aim.end, aim.beyond});
    return q_;
  }

 private:
  [[nodiscard]] Vector3d placeOf(int n) const {
    if (n == kRightClavicleNode) return fk_.origin(Bone::RightClavicle);
    if (n == kLeftClavicleNode) return fk_.origin(Bone::LeftClavicle);
    return fk_.position(points_[static_cast<std::size_t>(n)]);
  }
  void wish(int n, const Vector3d& p) {
    auto& wanted = wanted_[static_cast<std::size_t>(n)];
    wanted = wanted ? Vector3d(0.5 * (*wanted + p)) : p;
  }
  // From the targets towards the pelvis: where each node should be for its bones to keep their lengths.
  void reachInwards() {
    for (int n = 0; n < kNodeCount; ++n) {
      auto& wanted = wanted_[static_cast<std::size_t>(n)];
      wanted.reset();
      if (n < kJointCount && targets_.has(static_cast<Joint>(n))) wanted = targets_.p_world.col(n);
    }
    for (const Limb& limb : kLimbs) {
      for (int i = 0; i + 1 < limb.count; ++i) {
        const int outer = limb.nodes[static_cast<std::size_t>(i)];
        const int inner = limb.nodes[static_cast<std::size_t>(i) + 1];
        const auto& placed = wanted_[static_cast<std::size_t>(outer)];
        if (!placed) continue;
        const double length_m = (placeOf(inner) - placeOf(outer)).norm();
        const Vector3d along = placeOf(inner) - *placed;
        if (along.norm() > 1e-9) wish(inner, *placed + along.normalized() * length_m);
      }
    }
    const auto pulled = rigidMotion(kGirdle, node(Joint::Spine));
    if (pulled) wish(node(Joint::Spine), *pulled * placeOf(node(Joint::Spine)));
  }
  // The rigid motion that brings a piece's nodes nearest to where they should be, `but` one; nothing if none is wanted.
  [[nodiscard]] std::optional<Eigen::Isometry3d> rigidMotion(const std::array<int, 4>& nodes, int but) const {
    Vector3d from = Vector3d::Zero();
    Vector3d to = Vector3d::Zero();
    double count = 0;
    const auto each = [&](const auto& use) {
      for (const int n : nodes) {
        const auto& wanted = wanted_[static_cast<std::size_t>(n)];
        if (n != but && wanted) use(placeOf(n), *wanted);
      }
    };
    each([&](const Vector3d& p, const Vector3d& goal) {
      from += p;
      to += goal;
      ++count;
    });
    if (count == 0) return std::nullopt;
    from /= count;
    to /= count;
    Matrix3d S = kStay * Matrix3d::Identity();
    each([&](const Vector3d& p, const Vector3d& goal) { S += (goal - to) * (p - from).transpose(); });
    Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
    motion.linear() = bestRotation(S);
    motion.translation() = to - motion.linear() * from;
    return motion;
  }
  void placePelvis() {
    const auto motion = rigidMotion(kPelvis, -1);
    if (!motion) return;
    q_.head<3>() = *motion * fk_.origin(Bone::Root);
    setLocalRotation(Bone::Root, motion->linear() * fk_.R_world_bone(Bone::Root), q_);
    fk_.update(skeleton_, q_);
  }
  // Turns a bone about its origin so that the first wanted node, and less so the others of a limb, come nearest.
  template <std::size_t N>
  void turnTo(Bone bone, const std::array<int, N>& nodes) {
    const Vector3d origin = fk_.origin(bone);
    Matrix3d S = Matrix3d::Zero();
    bool is_wanted = false;
    for (std::size_t i = 0; i < N; ++i) {
      if (nodes[i] < 0 || !wanted_[static_cast<std::size_t>(nodes[i])]) continue;
      is_wanted = true;
      const double weight = N == 2 && i == 1 ? kBeyond : 1.0;
      S += weight * (*wanted_[static_cast<std::size_t>(nodes[i])] - origin) * (placeOf(nodes[i]) - origin).transpose();
    }
    if (!is_wanted) return;
    S += kStay * S.norm() * Matrix3d::Identity();
    const int parent = kBoneParents[static_cast<std::size_t>(bone)];
    DMC_CHECK(parent >= 0);
    const Matrix3d R_world_bone = bestRotation(S) * fk_.R_world_bone(bone);
    setLocalRotation(bone, fk_.R_world_bone(static_cast<Bone>(parent)).transpose() * R_world_bone, q_);
    q_ = clampedToLimits(q_);
    fk_.update(skeleton_, q_);
  }

  const Skeleton& skeleton_;
  const JointTargets& targets_;
  std::array<BonePoint, kJointCount> points_;
  ForwardKinematics fk_;
  Places wanted_;
  Pose q_;
};

}  // namespace

IkResult solveFabrik(const Skeleton& skeleton, const JointTargets& targets, const Pose& q) {
  TargetTerm term(skeleton, targets);
  Fabrik fabrik(skeleton, targets, q);
  ClosestSoFar closest(q, term.rms(q));
  while (closest.goesOn(kMaxIterations)) {
    const Pose& next = fabrik.iterate();
    closest.add(next, term.rms(next));
  }
  return closest.result();
}

}  // namespace depthmocap

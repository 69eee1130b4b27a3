#include "libtracker/body/makehuman_rest.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "depthmocap/error.h"
#include "libtracker/body/skin_weights.h"

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// How far our T-pose lifts the clavicles out of the A-pose [rad]: less than the rig's own T-pose (0.37), so that the
// shoulders lie as far below the neck as in an average skeleton and do not look shrugged when the arms hang.
constexpr double kClavicleLift = 0.10;
// The rig's neck joint sits within the neck; ours is its base, this share of the way down to the clavicles.
constexpr double kNeckBaseShare = 0.45;
// Our pelvis above the hips, crown above the head centre and spine joint, as in an average skeleton.
constexpr double kHipDropPerStature = 0.017;
constexpr double kCrownPerNeckToHead = 0.70;
constexpr double kSpinePerTorso = 0.346;
// Where the middle of the head lies before the neck's axis [m per stature].
constexpr double kHeadForward = 0.008;

struct Side {
  double sign;
  const char *shoulder, *arm, *fore_arm, *hand, *up_leg, *leg, *foot, *toe;
  Bone clavicle, humerus, radius, femur, tibia, foot_bone;
};
constexpr Side kSides[] = {
    {1.0, "LeftShoulder", "LeftArm", "LeftForeArm", "LeftHand", "LeftUpLeg", "LeftLeg", "LeftFoot", "LeftToeBase",
     Bone::LeftClavicle, Bone::LeftHumerus, Bone::LeftRadius, Bone::LeftFemur, Bone::LeftTibia, Bone::LeftFoot},
    {-1.0, "RightShoulder", "RightArm", "RightForeArm", "RightHand", "RightUpLeg", "RightLeg", "RightFoot",
     "RightToeBase", Bone::RightClavicle, Bone::RightHumerus, Bone::RightRadius, Bone::RightFemur, Bone::RightTibia,
     Bone::RightFoot}};

// The motion of one bone from the A-pose to the zero pose.
struct Motion {
  Matrix3d R = Matrix3d::Identity();
  Vector3d t = Vector3d::Zero();
  Vector3d operator*(const Vector3d& p) const { return R * p + t; }
  static Motion moving(const Matrix3d& rotation, const Vector3d& from, const Vector3d& to) {
    return {rotation, to - rotation * from};
  }
};
using Motions = std::array<Motion, kBoneCount>;

Motion& of(Motions& motions, Bone bone) {
  return motions[static_cast<std::size_t>(bone)];
}

class APose {
 public:
  APose(const std::vector<Eigen::Vector3f>& vertices, const MakeHumanJoints& joints)
      : vertices_(vertices), joints_(joints) {}
  // The joint at the head of a rig bone [m].
  [[nodiscard]] Vector3d joint(const std::string& bone) const {
    const auto found = joints_.find(bone);
    if (found == joints_.end()) throw Error("bone " + bone + " is missing", "MakeHuman rig", "use rig.cmu_mb.json");
    Vector3d sum = Vector3d::Zero();
    for (const std::uint32_t v : found->second) sum += vertices_[v].cast<double>();
    return sum / static_cast<double>(found->second.size());
  }
  [[nodiscard]] double meanDistance(const char* Side::*from, const char* Side::*to) const {
    double sum = 0;
    for (const Side& side : kSides) sum += (joint(side.*from) - joint(side.*to)).norm();
    return 0.5 * sum;
  }

 private:
  const std::vector<Eigen::Vector3f>& vertices_;
  const MakeHumanJoints& joints_;
};

// Orthonormal frame with the first column along `main` and the second along the part of `other` across it.
Matrix3d frame(const Vector3d& main, const Vector3d& other) {
  Matrix3d F;
  F.col(0) = main.normalized();
  F.col(1) = (other - F.col(0) * F.col(0).dot(other)).normalized();
  F.col(2) = F.col(0).cross(F.col(1));
  return F;
}

Matrix3d turning(const Vector3d& from, const Vector3d& to) {
  return Eigen::Quaterniond::FromTwoVectors(from, to).toRotationMatrix();
}

struct Extent {
  double low_y, high_y, head_front, head_back;
};

Extent extentOf(const std::vector<Eigen::Vector3f>& vertices, const std::vector<BoneWeights>& weights) {
  Extent e{1e9, -1e9, -1e9, 1e9};
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Vector3d v = vertices[i].cast<double>();
    e.low_y = std::min(e.low_y, v.y());
    e.high_y = std::max(e.high_y, v.y());
    if (weights[i][static_cast<std::size_t>(Bone::Head)] < 0.99F) continue;
    e.head_front = std::max(e.head_front, v.z());
    e.head_back = std::min(e.head_back, v.z());
  }
  return e;
}

// Lifts a clavicle and brings its shoulder into the plane of the trunk.
Motion liftedClavicle(const APose& pose, const Side& side, const Vector3d& root) {
  const Vector3d clavicle = pose.joint(side.shoulder);
  const Matrix3d lift = Eigen::AngleAxisd(side.sign * kClavicleLift, Vector3d::UnitZ()).toRotationMatrix();
  Motion motion = Motion::moving(lift, clavicle, clavicle - root);
  motion.t.z() -= (motion * pose.joint(side.arm)).z();
  return motion;
}

BoneLengths measure(const APose& pose, const Extent& extent, Vector3d& root) {
  BoneLengths l;
  l.upper_arm = pose.meanDistance(&Side::arm, &Side::fore_arm);
  l.lower_arm = pose.meanDistance(&Side::fore_arm, &Side::hand);
  l.upper_leg = pose.meanDistance(&Side::up_leg, &Side::leg);
  l.lower_leg = pose.meanDistance(&Side::leg, &Side::foot);
  l.foot = pose.meanDistance(&Side::foot, &Side::toe);
  const Vector3d left_hip = pose.joint(kSides[0].up_leg);
  const Vector3d right_hip = pose.joint(kSides[1].up_leg);
  l.hip_width = std::abs(left_hip.x() - right_hip.x());
  l.hip_drop = kHipDropPerStature * (extent.high_y - extent.low_y);
  root = 0.5 * (left_hip + right_hip) + Vector3d(0, l.hip_drop, 0);
  const double neck_y = pose.joint("Neck").y();
  const double clavicle_y = 0.5 * (pose.joint(kSides[0].shoulder) + pose.joint(kSides[1].shoulder)).y();
  l.torso = neck_y + kNeckBaseShare * (clavicle_y - neck_y) - root.y();
  l.spine = kSpinePerTorso * l.torso;
  l.neck_to_head = (extent.high_y - root.y() - l.torso) / (1.0 + kCrownPerNeckToHead);
  const Vector3d left = liftedClavicle(pose, kSides[0], root) * pose.joint(kSides[0].arm);
  const Vector3d right = liftedClavicle(pose, kSides[1], root) * pose.joint(kSides[1].arm);
  l.shoulder_width = left.x() - right.x();
  l.shoulder_drop = l.torso - 0.5 * (left.y() + right.y());
  return l;
}

void moveLimbs(const APose& pose, const Side& side, const Vector3d& root, const Skeleton& s, Motions& motions) {
  const BoneLengths& l = s.lengths;
  of(motions, side.clavicle) = liftedClavicle(pose, side, root);
  const Vector3d shoulder = pose.joint(side.arm);
  const Vector3d elbow = pose.joint(side.fore_arm);
  const Vector3d wrist = pose.joint(side.hand);
  // The elbow's bend in the A-pose shows its axis, which is vertical in our zero pose.
  const Vector3d bend = (elbow - shoulder).cross(wrist - elbow);
  const Matrix3d straight = frame({side.sign, 0, 0}, {0, -side.sign, 0});
  const Vector3d to_shoulder(0.5 * side.sign * l.shoulder_width, l.torso - l.shoulder_drop, 0);
  const Vector3d to_elbow = to_shoulder + Vector3d(side.sign * l.upper_arm, 0, 0);
  of(motions, side.humerus) =
      Motion::moving(straight * frame(elbow - shoulder, bend).transpose(), shoulder, to_shoulder);
  of(motions, side.radius) = Motion::moving(straight * frame(wrist - elbow, bend).transpose(), elbow, to_elbow);

  const Vector3d hip = pose.joint(side.up_leg);
  const Vector3d knee = pose.joint(side.leg);
  const Vector3d ankle = pose.joint(side.foot);
  const Vector3d toe = pose.joint(side.toe);
  const Vector3d to_hip(0.5 * side.sign * l.hip_width, -l.hip_drop, 0);
  const Vector3d to_knee = to_hip - Vector3d(0, l.upper_leg, 0);
  const Vector3d to_ankle = to_knee - Vector3d(0, l.lower_leg, 0);
  of(motions, side.femur) = Motion::moving(turning(knee - hip, -Vector3d::UnitY()), hip, to_hip);
  of(motions, side.tibia) = Motion::moving(turning(ankle - knee, -Vector3d::UnitY()), knee, to_knee);
  of(motions, side.foot_bone) = Motion::moving(
      frame(s.left_toe, Vector3d::UnitY()) * frame(toe - ankle, Vector3d::UnitY()).transpose(), ankle, to_ankle);
}

BodySurface::Skin skinFor(const Skeleton& skeleton, const Eigen::Vector3f& p, const BoneWeights& row) {
  DenseWeights weights{};
  for (std::size_t b = 0; b < kBoneCount; ++b) weights[b] = static_cast<double>(row[b]);
  double& lower = weights[static_cast<std::size_t>(Bone::Root)];
  double& upper = weights[static_cast<std::size_t>(Bone::UpperBack)];
  const double trunk = lower + upper;
  upper = trunk * upperBackShare(skeleton.lengths, static_cast<double>(p.y()));
  lower = trunk - upper;
  splitTwist(skeleton, p.cast<double>(), weights);
  return packedWeights(weights);
}

}  // namespace

BodySurface inZeroPose(const std::vector<Eigen::Vector3f>& vertices, const MakeHumanJoints& joints,
                       const std::vector<BoneWeights>& weights, double stature_m) {
  const APose pose(vertices, joints);
  const Extent extent = extentOf(vertices, weights);
  Vector3d root;
  BoneLengths lengths = measure(pose, extent, root);
  BodySurface body;
  body.skeleton = makeSkeleton(lengths);

  Motions motions;
  for (Motion& motion : motions) motion.t = -root;
  // Our shoulders and hips lie in one plane, the rig's shoulders a little before it: the trunk keeps its place between
  // the shoulders.
  const double shoulder_z = 0.5 * (pose.joint(kSides[0].arm) + pose.joint(kSides[1].arm)).z();
  for (const Bone bone : {Bone::Root, Bone::UpperBack, Bone::Neck}) of(motions, bone).t.z() = -shoulder_z;
  // The head sits upright over the neck: the zero pose has no forward bend of the neck.
  of(motions, Bone::Head).t.z() =
      kHeadForward * (extent.high_y - extent.low_y) - 0.5 * (extent.head_front + extent.head_back);
  for (const Side& side : kSides) moveLimbs(pose, side, root, body.skeleton, motions);

  double low = 1e9;
  double high = -1e9;
  body.vertices.reserve(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const Vector3d v = vertices[i].cast<double>();
    Vector3d moved = Vector3d::Zero();
    for (std::size_t b = 0; b < kBoneCount; ++b) {
      if (weights[i][b] > 0) moved += static_cast<double>(weights[i][b]) * (motions[b] * v);
    }
    low = std::min(low, moved.y());
    high = std::max(high, moved.y());
    body.vertices.push_back(moved.cast<float>());
  }
  if (stature_m > 0) {
    const double scale = stature_m / (high - low);
    for (Eigen::Vector3f& v : body.vertices) v *= static_cast<float>(scale);
    lengths = lengths.scaled(scale);
    body.skeleton = makeSkeleton(lengths);
  }
  body.skin.reserve(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i)
    body.skin.push_back(skinFor(body.skeleton, body.vertices[i], weights[i]));
  return body;
}

}  // namespace depthmocap

#include "libtracker/body/skin_weights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

double smoothStep(double from, double to, double value) {
  const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

std::size_t at(Bone bone) {
  return static_cast<std::size_t>(bone);
}

struct LimbBones {
  Bone clavicle, humerus, radius, femur, tibia, foot;
};
constexpr LimbBones kRight{Bone::RightClavicle, Bone::RightHumerus, Bone::RightRadius,
                           Bone::RightFemur,    Bone::RightTibia,   Bone::RightFoot};
constexpr LimbBones kLeft{Bone::LeftClavicle, Bone::LeftHumerus, Bone::LeftRadius,
                          Bone::LeftFemur,    Bone::LeftTibia,   Bone::LeftFoot};

// Share of the arm at (x >= 0, y): a plane through the shoulder that leans outwards below, so that the side of the
// chest under the armpit stays with the trunk.
double armShare(const BoneLengths& l, double x, double y) {
  const double shoulder_x = 0.5 * l.shoulder_width;
  const double shoulder_y = l.torso - l.shoulder_drop;
  const double half = 0.20 * l.upper_arm;
  const double drop = std::max(0.0, shoulder_y - y);
  const double lean = 0.6 * drop + 0.8 * std::max(0.0, drop - 0.20 * l.upper_arm);
  return smoothStep(-half, half, x - shoulder_x - lean);
}

double clavicleShare(const BoneLengths& l, double x, double y) {
  const double shoulder_x = 0.5 * l.shoulder_width;
  const double shoulder_y = l.torso - l.shoulder_drop;
  return smoothStep(0.15 * shoulder_x, 0.95 * shoulder_x, x) *
         smoothStep(shoulder_y - 0.45 * l.upper_arm, shoulder_y, y);
}

// Share of the leg: across the crease in front, wider and lower over the buttock; the crotch stays with the pelvis.
double legShare(const BoneLengths& l, double x, double y, double z) {
  const double hip_y = -l.hip_drop;
  const double behind = smoothStep(0.05 * l.upper_leg, -0.2 * l.upper_leg, z);
  const double crease = hip_y - 0.04 * l.upper_leg + 0.40 * (x - 0.5 * l.hip_width) - 0.07 * l.upper_leg * behind;
  const double half = (0.15 + 0.06 * behind) * l.upper_leg;
  const double share = smoothStep(-half, half, crease - y);
  const double near_crotch = smoothStep(hip_y - 0.38 * l.upper_leg, hip_y - 0.20 * l.upper_leg, y);
  return share * (1.0 - near_crotch * (1.0 - smoothStep(-0.02 * l.upper_leg, 0.12 * l.upper_leg, x)));
}

}  // namespace

BodySurface::Skin packedWeights(const DenseWeights& weights) {
  std::array<std::uint8_t, kSkinBoneCount> order;
  std::iota(order.begin(), order.end(), std::uint8_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return weights[a] > weights[b]; });
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += weights[order[i]];
  DMC_CHECK(sum > 0);
  BodySurface::Skin skin;
  for (std::size_t i = 0; i < 4; ++i) {
    if (weights[order[i]] <= 1e-4 * sum) break;
    skin.bone[i] = order[i];
    skin.weight[i] = static_cast<float>(weights[order[i]] / sum);
  }
  const float total = std::accumulate(skin.weight.begin(), skin.weight.end(), 0.0F);
  for (float& w : skin.weight) w /= total;
  return skin;
}

void splitTwist(const Skeleton& skeleton, const Eigen::Vector3d& p, DenseWeights& weights) {
  const BoneLengths& l = skeleton.lengths;
  const double arm = smoothStep(0.0, 0.75 * l.upper_arm, std::abs(p.x()) - 0.5 * l.shoulder_width);
  const double leg = smoothStep(0.0, 0.75 * l.upper_leg, -l.hip_drop - p.y());
  const auto split = [&](Bone bone, int untwisted, double share) {
    const double whole = weights[at(bone)];
    weights[at(bone)] = whole * share;
    weights[static_cast<std::size_t>(untwisted)] = whole * (1.0 - share);
  };
  split(Bone::RightHumerus, kRightHumerusUntwisted, arm);
  split(Bone::LeftHumerus, kLeftHumerusUntwisted, arm);
  split(Bone::RightFemur, kRightFemurUntwisted, leg);
  split(Bone::LeftFemur, kLeftFemurUntwisted, leg);
}

double upperBackShare(const BoneLengths& l, double y) {
  return smoothStep(0.3 * l.spine, 1.6 * l.spine, y);
}

BodySurface::Skin skinOfPoint(const Skeleton& skeleton, const Eigen::Vector3f& point) {
  const BoneLengths& l = skeleton.lengths;
  const Eigen::Vector3d p = point.cast<double>();
  const LimbBones& bones = p.x() > 0 ? kLeft : kRight;
  const double x = std::abs(p.x());
  DenseWeights weights{};

  const double arm = armShare(l, x, p.y());
  const double elbow_x = 0.5 * l.shoulder_width + l.upper_arm;
  const double fore = smoothStep(elbow_x - 0.16 * l.upper_arm, elbow_x + 0.16 * l.upper_arm, x);
  weights[at(bones.humerus)] = arm * (1.0 - fore);
  weights[at(bones.radius)] = arm * fore;

  const double leg = (1.0 - arm) * legShare(l, x, p.y(), p.z());
  const double knee_y = -l.hip_drop - l.upper_leg;
  const double ankle_y = knee_y - l.lower_leg;
  const double shank = smoothStep(knee_y + 0.12 * l.upper_leg, knee_y - 0.12 * l.upper_leg, p.y());
  const double foot = smoothStep(ankle_y + 0.08 * l.lower_leg, ankle_y - 0.05 * l.lower_leg, p.y());
  weights[at(bones.femur)] = leg * (1.0 - shank);
  weights[at(bones.tibia)] = leg * shank * (1.0 - foot);
  weights[at(bones.foot)] = leg * shank * foot;

  const double trunk = (1.0 - arm) * (1.0 - leg);
  const double n = l.neck_to_head;
  const double neck_height = p.y() - l.torso - 0.4 * std::max(0.0, x - 0.3 * n);
  const double neck = smoothStep(-0.15 * n, 0.30 * n, neck_height);
  const double head = smoothStep(0.10 * n, 0.75 * n, p.y() - l.torso + 0.35 * p.z());
  weights[at(Bone::Neck)] = trunk * neck * (1.0 - head);
  weights[at(Bone::Head)] = trunk * neck * head;

  const double upper = trunk * (1.0 - neck) * upperBackShare(l, p.y());
  const double clavicle = clavicleShare(l, x, p.y());
  weights[at(bones.clavicle)] = upper * clavicle;
  weights[at(Bone::UpperBack)] = upper * (1.0 - clavicle);
  weights[at(Bone::Root)] = trunk * (1.0 - neck) - upper;
  splitTwist(skeleton, p, weights);
  return packedWeights(weights);
}

}  // namespace depthmocap

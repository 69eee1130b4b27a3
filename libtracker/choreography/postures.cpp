#include "libtracker/choreography/postures.h"

#include <algorithm>
#include <cmath>

#include "libtracker/choreography/easing.h"

namespace depthmocap {
namespace {

constexpr double kShoulderFromMiddle = 0.175;  // [m] of an average body

// Inside the trunk or the head, or so near that the forearm must be; seen from one shoulder.
bool insideBody(const HandTarget& hand) {
  const double side = std::abs(hand.out + kShoulderFromMiddle);
  const bool trunk = side < 0.20 && std::abs(hand.forward) < 0.17 && hand.up > -0.60 && hand.up < 0.10;
  const bool head = side < 0.15 && std::abs(hand.forward) < 0.17 && hand.up >= 0.05 && hand.up < 0.42;
  return trunk || head;
}

ArmAngles blend(const ArmAngles& a, const ArmAngles& b, double u) {
  return {lerp(a.clavicle_y, b.clavicle_y, u), lerp(a.clavicle_z, b.clavicle_z, u), lerp(a.twist, b.twist, u),
          lerp(a.swing_y, b.swing_y, u),       lerp(a.swing_z, b.swing_z, u),       lerp(a.elbow, b.elbow, u)};
}

}  // namespace

KeyPose standing(double half_width) {
  KeyPose key;
  key.left_foot.out = key.right_foot.out = half_width;
  return key;
}

HandTarget randomReach(Random& random) {
  for (;;) {
    const double up = random.uniform(-1.0, 1.0);
    const double azimuth = random.uniform(degrees(-150), degrees(65));  // 0 forward, negative outwards
    const double radius = random.uniform(0.26, 0.55);
    const double level = std::sqrt(1.0 - up * up);
    const HandTarget hand{-radius * level * std::sin(azimuth), radius * up, radius * level * std::cos(azimuth),
                          random.uniform(-0.4, 0.6)};
    if (!insideBody(hand)) return hand;
  }
}

void guideHand(const Skeleton& skeleton, Side side, const HandPath& path, double ease_s, double follow,
               BodyFrames& frames) {
  const double end = static_cast<double>(frames.size() - 1) / kMotionFps;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double t = static_cast<double>(i) / kMotionFps;
    const double share = minimumJerk(std::min(t, end - t) / ease_s);
    const HandTarget hand = path(t);
    BodyFrame& frame = frames[i];
    frame.arm(side) = blend(frame.arm(side), reachArm(skeleton, hand), share);
    const double yaw = std::atan2(sideSign(side) * (kShoulderFromMiddle + hand.out), std::max(0.15, hand.forward));
    frame.spine.twist += 0.18 * follow * share * yaw;
    frame.head.turn += 0.35 * follow * share * yaw;
    frame.head.nod -= 0.35 * follow * share * hand.up;
    frame.spine.bend -= 0.10 * follow * share * hand.up;
  }
}

void overlayUpperBody(const BodyFrames& arms, BodyFrames& frames) {
  frames.resize(std::min(frames.size(), arms.size()));
  for (std::size_t t = 0; t < frames.size(); ++t) {
    frames[t].left_arm = arms[t].left_arm;
    frames[t].right_arm = arms[t].right_arm;
    frames[t].spine.bend += arms[t].spine.bend;
    frames[t].spine.twist += arms[t].spine.twist;
    frames[t].spine.side += arms[t].spine.side;
    frames[t].head.nod += arms[t].head.nod;
    frames[t].head.turn += arms[t].head.turn;
  }
}

void displace(double dx, double dz, double turn, BodyFrame& frame) {
  const PelvisState center = frame.pelvis;
  for (FootState* foot : {&frame.left_foot, &frame.right_foot}) {
    const double x = foot->x - center.x;
    const double z = foot->z - center.z;
    foot->x = center.x + dx + std::cos(turn) * x + std::sin(turn) * z;
    foot->z = center.z + dz - std::sin(turn) * x + std::cos(turn) * z;
    foot->heading += turn;
  }
  frame.pelvis.x += dx;
  frame.pelvis.z += dz;
  frame.pelvis.heading += turn;
}

}  // namespace depthmocap

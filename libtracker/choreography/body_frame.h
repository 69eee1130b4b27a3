#pragma once
#include <Eigen/Core>
#include <vector>

namespace depthmocap {

enum class Side { Left, Right };

// One frame of a motion as its author thinks of it: where the pelvis is, how the trunk and the arms turn and where the
// feet stand. solveBody() (body_solver.h) turns it into a pose. Plain numbers, so that frames can be interpolated
// channel by channel.

struct PelvisState {
  double x = 0, z = 0;  // [m] world
  double y = 0;         // [m] above (+) the height of standing with straight legs
  double heading = 0;   // [rad] as kRootRy
  double lean = 0;      // [rad] forward, as kRootRx
  double tilt = 0;      // [rad] to the right, as kRootRz
  double held = 0;      // [0, 1] how far something else than the feet keeps the balance: a chair, a gait
};

struct SpineState {
  double bend = 0, twist = 0, side = 0;  // [rad] as kUpperbackRx, Ry, Rz
};

struct HeadState {
  double nod = 0, side = 0, turn = 0;  // [rad] as kNeckRx, kNeckRz, kHeadRy
};

// The arm's DoFs [rad] with the signs of the left arm; the right arm is the mirror image.
struct ArmAngles {
  double clavicle_y = 0, clavicle_z = 0;
  double twist = 0, swing_y = 0, swing_z = 0;
  double elbow = 0;  // as kLradiusRy: negative bends
};

// A foot by the floor point under its ankle when it stands flat. Pitch > 0 rolls it over the toe (heel up), pitch < 0
// over the heel (toes up), so a foot that does not move x, z, ground and lift does not slide whatever its pitch.
struct FootState {
  double x = 0, z = 0;   // [m] world
  double ground = 0;     // [m] height of the surface below it
  double lift = 0;       // [m] above the surface
  double pitch = 0;      // [rad]
  double heading = 0;    // [rad] of the toes, in the world
  double heel_rise = 0;  // [rad] how far the heel may come up by itself when the leg is too short
  double knee_out = 0;   // [rad] turns the knee outwards, beyond the foot's heading
};

struct BodyFrame {
  PelvisState pelvis;
  SpineState spine;
  HeadState head;
  ArmAngles left_arm, right_arm;
  FootState left_foot, right_foot;

  ArmAngles& arm(Side side) { return side == Side::Left ? left_arm : right_arm; }
  [[nodiscard]] const ArmAngles& arm(Side side) const { return side == Side::Left ? left_arm : right_arm; }
  FootState& foot(Side side) { return side == Side::Left ? left_foot : right_foot; }
  [[nodiscard]] const FootState& foot(Side side) const { return side == Side::Left ? left_foot : right_foot; }
};

using BodyFrames = std::vector<BodyFrame>;  // at kMotionFps

inline constexpr double kMotionFps = 30.0;
inline constexpr int kTrunkChannels = 13;
inline constexpr int kArmChannels = 12;
inline constexpr int kFootChannels = 16;
inline constexpr int kFrameChannels = kTrunkChannels + kArmChannels + kFootChannels;

// All numbers of a frame in a row: trunk, arms, feet; and back.
using FrameChannels = Eigen::Matrix<double, kFrameChannels, 1>;
FrameChannels channelsOf(const BodyFrame& frame);
BodyFrame frameOf(const FrameChannels& channels);

// +1 left, -1 right: the sign of x on that side.
constexpr double sideSign(Side side) {
  return side == Side::Left ? 1.0 : -1.0;
}

}  // namespace depthmocap

#include "libtracker/choreography/gait.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "libtracker/choreography/arm_ik.h"
#include "libtracker/choreography/easing.h"

namespace depthmocap {
namespace {

constexpr double kBodyBeforeFoot = 0.045;    // [m] the pelvis passes over the middle of the foot, not over the ankle
constexpr double kNoHeelRise = -1.0;         // [rad] the pitch curve says it all
constexpr double kFullActivitySpeed = 0.45;  // [m/s] from here on the arms swing and the pelvis turns fully
constexpr double kFullActivityTurn = 1.5;    // [rad/s]
constexpr double kActivityWindow = 0.35;     // [s]

struct CurvePoint {
  double phase;
  double pitch_deg;
};

// Pitch of the foot over stance (0 touchdown, 1 lift-off) and swing (1 .. 2), Winter (2009): heel strike, flat, push
// off, toe clearance.
constexpr std::array<CurvePoint, 11> kWalkPitch = {{{0.0, -18},
                                                    {0.13, 0},
                                                    {0.50, 0},
                                                    {0.64, 7},
                                                    {0.80, 24},
                                                    {1.0, 57},
                                                    {1.12, 60},
                                                    {1.40, 28},
                                                    {1.65, -4},
                                                    {1.88, -18},
                                                    {2.0, -18}}};
// Running with a nearly flat touchdown (Novacheck 1998): the shank folds up behind.
constexpr std::array<CurvePoint, 9> kRunPitch = {
    {{0.0, -4}, {0.15, 0}, {0.50, 0}, {0.75, 22}, {1.0, 58}, {1.22, 88}, {1.50, 62}, {1.78, 8}, {2.0, -4}}};

// The curve is periodic over [0, 2].
double curveAt(std::span<const CurvePoint> curve, double phase) {
  const std::size_t pieces = curve.size() - 1;
  const auto length = [&](std::size_t k) { return curve[k + 1].phase - curve[k].phase; };
  const auto slope = [&](std::size_t k) { return (curve[k + 1].pitch_deg - curve[k].pitch_deg) / length(k); };
  const auto slopeAtKey = [&](std::size_t key) {
    const std::size_t before = (key + pieces - 1) % pieces;
    const std::size_t after = key % pieces;
    return shapePreservingSlope(slope(before), slope(after), length(before), length(after));
  };
  std::size_t k = 0;
  while (k + 1 < pieces && phase >= curve[k + 1].phase) ++k;
  const HermiteWeights w = hermiteWeights((phase - curve[k].phase) / length(k), length(k));
  return degrees(w.a * curve[k].pitch_deg + w.b * slopeAtKey(k) + w.c * curve[k + 1].pitch_deg +
                 w.d * slopeAtKey(k + 1));
}

Eigen::Vector2d turned(double heading, double left, double forward) {
  return {std::cos(heading) * left + std::sin(heading) * forward,
          -std::sin(heading) * left + std::cos(heading) * forward};
}

class Walker {
 public:
  Walker(const WalkPath& path, const GaitStyle& style, double first_phase, const GroundHeight& ground)
      : path_(path), style_(style), ground_(ground), first_phase_(first_phase) {}

  [[nodiscard]] BodyFrame at(double t) const;

 private:
  // Cycles since the right foot's first touchdown; the left foot is half a cycle behind.
  [[nodiscard]] double cycles(double t, Side side) const {
    return t / style_.cycle_s + first_phase_ - (side == Side::Left ? 0.5 : 0.0);
  }
  [[nodiscard]] double timeOf(double cycle, Side side) const {
    return (cycle - first_phase_ + (side == Side::Left ? 0.5 : 0.0)) * style_.cycle_s;
  }
  [[nodiscard]] FootState standing(double cycle, Side side) const;
  [[nodiscard]] FootState foot(double t, Side side) const;
  [[nodiscard]] double activity(double t) const;
  [[nodiscard]] double groundAt(double x, double z) const { return ground_ ? ground_(x, z) : 0.0; }
  void poseTrunk(double t, double active, BodyFrame& frame) const;
  void poseArms(double t, double active, BodyFrame& frame) const;

  const WalkPath& path_;
  const GaitStyle& style_;
  const GroundHeight& ground_;
  double first_phase_;
};

FootState Walker::standing(double cycle, Side side) const {
  const PathPoint body = path_(timeOf(std::floor(cycle) + 0.5 * style_.duty - style_.passes_early, side));
  const Eigen::Vector2d offset = turned(body.heading, sideSign(side) * style_.half_width, -kBodyBeforeFoot);
  FootState state;
  state.x = body.x + offset.x();
  state.z = body.z + offset.y();
  state.heading = body.heading + sideSign(side) * style_.toe_out;
  state.ground = groundAt(state.x, state.z);
  return state;
}

FootState Walker::foot(double t, Side side) const {
  const double cycle = cycles(t, side);
  const double phase = cycle - std::floor(cycle);
  const FootState from = standing(cycle, side);
  const FootState to = standing(cycle + 1, side);
  const FootState before = standing(cycle - 1, side);
  const bool swings = phase >= style_.duty;
  const double curve_phase = swings ? 1.0 + (phase - style_.duty) / (1.0 - style_.duty) : phase / style_.duty;
  const double step = std::hypot(to.x - from.x, to.z - from.z) + 0.15 * std::abs(to.heading - from.heading);
  const double last_step = std::hypot(from.x - before.x, from.z - before.z);
  const double strength = std::clamp((curve_phase < 0.5 ? last_step : step) / 0.25, style_.always_active, 1.0);
  const std::span<const CurvePoint> curve = style_.running ? std::span<const CurvePoint>(kRunPitch) : kWalkPitch;
  // Walking backwards is walking with the time reversed.
  const double pitch = style_.foot_roll >= 0 ? curveAt(curve, curve_phase)
                                             : curveAt(curve, curve_phase <= 1 ? 1 - curve_phase : 3 - curve_phase);
  FootState state = from;
  if (swings) {
    const double u = minimumJerk(curve_phase - 1.0);
    const PathPoint body = path_(t);
    const PathPoint left_at = path_(timeOf(std::floor(cycle) + style_.duty, side));
    const PathPoint lands_at = path_(timeOf(std::floor(cycle) + 1.0, side));
    const double carried_x = body.x + lerp(from.x - left_at.x, to.x - lands_at.x, u);
    const double carried_z = body.z + lerp(from.z - left_at.z, to.z - lands_at.z, u);
    state.x = lerp(lerp(from.x, to.x, u), carried_x, style_.swing_carry);
    state.z = lerp(lerp(from.z, to.z, u), carried_z, style_.swing_carry);
    state.heading = lerp(from.heading, to.heading, u);
    state.ground = lerp(from.ground, to.ground, minimumJerk(1.5 * (curve_phase - 1.0)));
    if (to.ground < from.ground)
      state.ground = lerp(from.ground, to.ground, minimumJerk(1.5 * (curve_phase - 1.0) - 0.5));
    state.lift = style_.clearance * strength * bump(curve_phase - 1.0);
  }
  state.pitch = std::abs(style_.foot_roll) * strength * pitch + style_.foot_pitch;
  state.heel_rise = kNoHeelRise;
  return state;
}

double Walker::activity(double t) const {
  const PathPoint a = path_(t - kActivityWindow);
  const PathPoint b = path_(t + kActivityWindow);
  const double speed = std::hypot(b.x - a.x, b.z - a.z) / (2 * kActivityWindow);
  const double turn = std::abs(b.heading - a.heading) / (2 * kActivityWindow);
  return std::clamp(speed / kFullActivitySpeed + turn / kFullActivityTurn, style_.always_active, 1.0);
}

void Walker::poseTrunk(double t, double active, BodyFrame& frame) const {
  const PathPoint body = path_(t);
  const double right = cycles(t, Side::Right);
  const double middle = 0.5 * style_.duty;
  const Eigen::Vector2d sway = turned(body.heading, -style_.sway * active * wave(right - middle), 0.0);
  const double turn = style_.pelvis_turn * active * wave(right);
  frame.pelvis.x = body.x + sway.x();
  frame.pelvis.z = body.z + sway.y();
  frame.pelvis.y = -style_.crouch - std::abs(style_.bounce) - style_.bounce * active * wave(2 * (right - middle));
  frame.pelvis.y += 0.5 * (frame.left_foot.ground + frame.right_foot.ground);
  frame.pelvis.held = 1.0;
  frame.pelvis.heading = body.heading + turn;
  frame.pelvis.lean = style_.lean * (0.4 + 0.6 * active);
  frame.pelvis.tilt = -style_.pelvis_list * active * wave(right - 0.2);
  frame.spine.bend = style_.spine_bend;
  frame.spine.twist = -turn - style_.shoulder_turn * active * wave(right);
  frame.spine.side = -0.6 * frame.pelvis.tilt;
  frame.head.turn = style_.shoulder_turn * active * wave(right);
  frame.head.nod = style_.head_nod - 0.7 * (frame.pelvis.lean + frame.spine.bend);
}

void Walker::poseArms(double t, double active, BodyFrame& frame) const {
  for (const Side side : {Side::Left, Side::Right}) {
    const double swing = sideSign(side) * wave(cycles(t, Side::Right) - 0.04);
    const double flexion = style_.arm_forward + style_.arm_swing * active * swing;
    const double late = sideSign(side) * wave(cycles(t, Side::Right) - 0.10);
    frame.arm(side) = swingArm(flexion, style_.arm_out, style_.elbow + style_.elbow_swing * active * late);
  }
}

BodyFrame Walker::at(double t) const {
  BodyFrame frame;
  const double active = activity(t);
  frame.left_foot = foot(t, Side::Left);
  frame.right_foot = foot(t, Side::Right);
  poseTrunk(t, active, frame);
  poseArms(t, active, frame);
  return frame;
}

}  // namespace

BodyFrames walkAlong(const WalkPath& path, double duration_s, const GaitStyle& style, double first_phase,
                     const GroundHeight& ground) {
  const Walker walker(path, style, first_phase, ground);
  BodyFrames frames;
  for (int i = 0; i / kMotionFps <= duration_s; ++i) frames.push_back(walker.at(i / kMotionFps));
  return frames;
}

WalkPath straightPath(double forward, double sideways, double turn_rate) {
  return [=](double t) {
    if (std::abs(turn_rate) < 1e-6) return PathPoint{sideways * t, forward * t, 0.0};
    // An arc: the velocity turns with the body.
    const double a = turn_rate * t;
    return PathPoint{(forward * (1 - std::cos(a)) + sideways * std::sin(a)) / turn_rate,
                     (forward * std::sin(a) - sideways * (1 - std::cos(a))) / turn_rate, a};
  };
}

}  // namespace depthmocap

#include <array>
#include <cmath>

#include "libtracker/choreography/easing.h"
#include "libtracker/choreography/recipe.h"

// Walking and running in all ways and directions.

namespace depthmocap {
namespace {

RawMotion onFoot(Studio& studio, const WalkPath& path, double duration_s, const GaitStyle& style,
                 double liveliness = 1.0) {
  return {walkAlong(path, duration_s, style, studio.random.uniform()), liveliness};
}

// A walker's personal way; the speed [m/s] sets cadence, lean and swing (Winter 2009: both step length and cadence
// grow).
GaitStyle walkStyle(Studio& studio, double speed) {
  GaitStyle style;
  style.cycle_s = studio.near(1.36 - 0.24 * speed, 0.05);
  style.duty = 0.66 - 0.035 * speed;
  style.half_width = studio.near(0.075);
  style.toe_out = studio.random.uniform(0.0, 0.22);
  style.foot_roll = std::clamp(0.45 + 0.42 * speed, 0.5, 1.15);
  style.lean = 0.02 + 0.025 * speed + studio.random.uniform(-0.02, 0.03);
  style.arm_swing = (0.10 + 0.25 * speed) * studio.random.uniform(0.6, 1.3);
  style.arm_out = studio.random.uniform(0.06, 0.18);
  style.elbow = studio.random.uniform(0.25, 0.6);
  style.shoulder_turn = studio.near(0.04 + 0.05 * speed, 0.4);
  style.head_nod = studio.random.uniform(-0.05, 0.12);
  return style;
}

RawMotion walkAt(Studio& studio, double speed, double duration_s) {
  const double v = studio.near(speed, 0.08);
  return onFoot(studio, straightPath(v), duration_s, walkStyle(studio, v));
}

RawMotion walk(Studio& studio) {
  return walkAt(studio, 1.25, 4.0);
}
RawMotion walkSlow(Studio& studio) {
  return walkAt(studio, 0.7, 4.0);
}
RawMotion walkFast(Studio& studio) {
  return walkAt(studio, 1.75, 3.0);
}

RawMotion walkCircle(Studio& studio) {
  const double v = studio.near(1.0, 0.1);
  const double radius = studio.random.uniform(0.8, 1.1);
  return onFoot(studio, straightPath(v, 0, v / radius), 2 * std::numbers::pi * radius / v, walkStyle(studio, v));
}

// To and fro on a short line with turns, within the view of one camera.
RawMotion walkToAndFro(Studio& studio) {
  const double leg_s = 2.2;
  const double turn_s = 1.4;
  const double length = studio.random.uniform(1.4, 1.7);
  const auto path = [=](double t) {
    const double lap = leg_s + turn_s;
    const double n = std::floor(t / lap);
    const double s = t - n * lap;
    const bool forth = static_cast<int>(n) % 2 == 0;
    const double along = length * minimumJerk(s / leg_s);
    return PathPoint{0, forth ? along : length - along,
                     std::numbers::pi * (n + smoothStep((s - leg_s + 0.3) / turn_s))};
  };
  return onFoot(studio, path, 2 * (leg_s + turn_s), walkStyle(studio, 1.0));
}

RawMotion walkBackward(Studio& studio) {
  const double v = studio.random.uniform(0.5, 0.9);
  GaitStyle style = walkStyle(studio, v);
  style.foot_roll = -0.6;
  style.passes_early = -0.03;
  style.arm_swing *= -0.6;
  style.lean = -0.02;
  return onFoot(studio, straightPath(-v), 4.0, style);
}

RawMotion walkSideways(Studio& studio) {
  const double v = studio.random.uniform(0.35, 0.6);
  GaitStyle style = walkStyle(studio, 0.5);
  style.half_width = 0.16;
  style.foot_roll = 0.15;
  style.clearance = 0.05;
  style.pelvis_turn = 0.0;
  style.arm_swing = 0.05;
  style.arm_out = studio.random.uniform(0.1, 0.5);
  return onFoot(studio, straightPath(0, v), 3.5, style);
}

RawMotion tiptoe(Studio& studio) {
  const double v = studio.random.uniform(0.4, 0.8);
  GaitStyle style = walkStyle(studio, v);
  style.foot_pitch = 0.65;
  style.foot_roll = 0.15;
  style.clearance = 0.07;
  style.bounce = -0.004;
  style.arm_out = studio.random.uniform(0.2, 0.7);
  style.elbow = 0.6;
  return onFoot(studio, straightPath(v), 3.5, style);
}

// On the spot or forward with high knees and straight swinging arms.
RawMotion march(Studio& studio) {
  const double v = studio.variant % 2 == 0 ? 0.0 : 0.6;
  GaitStyle style = walkStyle(studio, 1.0);
  style.cycle_s = studio.near(1.05, 0.1);
  style.duty = 0.55;
  style.clearance = studio.random.uniform(0.22, 0.38);
  style.foot_roll = 0.45;
  style.arm_swing = studio.random.uniform(0.6, 1.0);
  style.elbow = studio.variant < 2 ? 0.3 : 1.2;
  style.always_active = 1.0;
  style.lean = 0.0;
  return onFoot(studio, straightPath(v), 4.0, style);
}

RawMotion sneak(Studio& studio) {
  const double v = studio.random.uniform(0.4, 0.6);
  GaitStyle style = walkStyle(studio, v);
  style.cycle_s = 1.6;
  style.crouch = studio.random.uniform(0.12, 0.22);
  style.lean = 0.25;
  style.spine_bend = 0.3;
  style.clearance = 0.10;
  style.arm_forward = 0.6;
  style.elbow = 1.3;
  style.arm_swing = 0.25;
  return onFoot(studio, straightPath(v), 4.0, style);
}

GaitStyle runStyle(Studio& studio, double speed) {
  GaitStyle style;
  style.running = true;
  style.cycle_s = studio.near(0.78 - 0.02 * speed, 0.05);
  style.duty = 0.44 - 0.03 * speed;
  style.half_width = 0.045;
  style.passes_early = 0.05;
  style.swing_carry = 0.5;
  style.clearance = 0.05 + 0.06 * speed;
  style.bounce = studio.near(0.035);
  style.crouch = 0.015;
  style.sway = 0.008;
  style.lean = 0.06 + 0.02 * speed;
  style.spine_bend = 0.06;
  style.pelvis_turn = 0.10;
  style.shoulder_turn = studio.near(0.22, 0.3);
  style.arm_swing = studio.near(0.35 + 0.1 * speed);
  style.arm_forward = -0.15;
  style.arm_out = studio.random.uniform(0.12, 0.3);
  style.elbow = studio.random.uniform(1.3, 1.7);
  style.elbow_swing = 0.25;
  return style;
}

RawMotion run(Studio& studio) {
  const double v = studio.near(2.2 + 0.55 * studio.variant, 0.06);
  return onFoot(studio, straightPath(v), 2.5, runStyle(studio, v));
}

// As the jogging of exercises: on the spot or slowly forward.
RawMotion jog(Studio& studio) {
  const double v = studio.variant % 2 == 0 ? 0.0 : studio.random.uniform(1.2, 1.8);
  GaitStyle style = runStyle(studio, std::max(v, 0.8));
  style.duty = 0.45;
  style.always_active = 0.8;
  return onFoot(studio, straightPath(v), 3.5, style);
}

constexpr std::array kRecipes = {
    Recipe{"walk", 3, &walk},
    Recipe{"walk_slow", 2, &walkSlow},
    Recipe{"walk_fast", 2, &walkFast},
    Recipe{"walk_circle", 2, &walkCircle},
    Recipe{"walk_to_and_fro", 2, &walkToAndFro},
    Recipe{"walk_backward", 2, &walkBackward},
    Recipe{"walk_sideways", 2, &walkSideways},
    Recipe{"tiptoe", 2, &tiptoe},
    Recipe{"march", 4, &march},
    Recipe{"sneak", 2, &sneak},
    Recipe{"run", 4, &run},
    Recipe{"jog", 2, &jog},
};

}  // namespace

std::span<const Recipe> locomotionRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

#include <array>
#include <cmath>

#include "libtracker/choreography/easing.h"
#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Jumping and hopping: key postures for the body, a parabola for the flight.

namespace depthmocap {
namespace {

constexpr double kGravity = 9.81;  // [m/s^2]

double airTime(double height) {
  return 2.0 * std::sqrt(2.0 * height / kGravity);
}

struct Flight {
  double start_s;
  double height;                         // [m]
  double tuck = 0.0;                     // [m] the feet are pulled up
  double sideways = 0.0, forward = 0.0;  // [m]
  double turn = 0.0;                     // [rad]
};

// From start_s on the body is in the air, and afterwards stands elsewhere.
void fly(const Flight& flight, BodyFrames& frames) {
  const double duration = airTime(flight.height);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double t = static_cast<double>(i) / kMotionFps - flight.start_s;
    if (t <= 0) continue;
    const double u = std::min(1.0, t / duration);
    const double up = 4.0 * flight.height * u * (1.0 - u);
    BodyFrame& frame = frames[i];
    frame.pelvis.y += up;
    for (FootState* foot : {&frame.left_foot, &frame.right_foot}) foot->lift += up + flight.tuck * bump(u);
    displace(u * flight.sideways, u * flight.forward, flight.turn * smoothStep(u), frame);
  }
}

struct JumpPlan {
  double height, tuck = 0.0;
  double forward = 0.0, sideways = 0.0, turn = 0.0;
  HandTarget take_off{-0.02, 0.30, 0.42, 0.0};
  int count = 2;
};

RawMotion jumps(Studio& studio, const JumpPlan& plan) {
  KeySequence s(standing(studio.uniform(0.09, 0.16)));
  std::vector<Flight> flights;
  s.at(0.0);
  for (int i = 0; i < plan.count; ++i) {
    const double height = studio.near(plan.height);
    KeyPose& crouch = s.base(studio.uniform(0.4, 0.6));
    crouch.pelvis.y = -studio.uniform(0.18, 0.32);
    crouch.pelvis.lean = 0.35;
    crouch.spine.bend = 0.30;
    setHands(crouch, {0.10, -0.42, -0.28, 0.0});
    KeyPose& off = s.base(0.26);
    off.pelvis.y = 0.06;
    off.left_foot.pitch = off.right_foot.pitch = 0.75;
    off.pelvis.lean = plan.forward > 0.1 ? 0.25 : 0.03;
    setHands(off, plan.take_off);
    flights.push_back({off.time_s, height, plan.tuck, plan.sideways, plan.forward, plan.turn});
    KeyPose& down = s.then(airTime(height));
    down.pelvis.y = 0.0;
    down.left_foot.pitch = down.right_foot.pitch = 0.25;
    setHands(down, {0.18, -0.30, 0.25, 0.1});
    KeyPose& land = s.base(0.22);
    land.pelvis.y = -studio.uniform(0.15, 0.28);
    land.pelvis.lean = 0.30;
    land.spine.bend = 0.25;
    setHands(land, {0.16, -0.45, 0.15, 0.1});
    s.base(0.5);
  }
  BodyFrames frames =
      playKeys(studio.skeleton, s, {.hand_spread = 0.03, .angle_spread = 0.03, .heel_rise = 0.0}, studio.random);
  for (const Flight& flight : flights) fly(flight, frames);
  return {frames};
}

RawMotion jumpInPlace(Studio& studio) {
  return jumps(studio, {.height = studio.uniform(0.12, 0.35)});
}
RawMotion jumpTuck(Studio& studio) {
  return jumps(studio, {.height = 0.35, .tuck = studio.uniform(0.15, 0.3), .take_off = {0.0, -0.05, 0.50, 0.0}});
}
RawMotion jumpForward(Studio& studio) {
  return jumps(studio, {.height = 0.22, .tuck = 0.08, .forward = studio.uniform(0.5, 0.9)});
}
RawMotion jumpTurn(Studio& studio) {
  return jumps(
      studio,
      {.height = 0.25, .turn = studio.chance(0.5) ? 1.57 : 3.14, .take_off = {0.30, -0.05, 0.20, 0.2}, .count = 3});
}
RawMotion jumpSide(Studio& studio) {
  return jumps(studio, {.height = 0.15, .sideways = studio.uniform(0.3, 0.6), .take_off = {0.35, -0.10, 0.25, 0.2}});
}

RawMotion jumpingJack(Studio& studio) {
  const double half_s = studio.uniform(0.42, 0.58);
  const double wide = studio.uniform(0.30, 0.42);
  const double up = studio.variant == 2 ? 0.15 : 0.5;
  KeySequence s(standing(0.09));
  std::vector<Flight> flights;
  s.at(0.0);
  for (int i = 0; i < 8; ++i) {
    const double start = s.end();
    KeyPose& key = s.base(half_s);
    if (i % 2 == 0) {
      key.left_foot.out = key.right_foot.out = wide;
      key.pelvis.y = -0.06;
      setHands(key, {0.54 * std::cos(std::asin(up / 0.54)) * 0.9, up, 0.04, 0.1});
    }
    flights.push_back({start + 0.35 * half_s, 0.02});
    KeyPose& rest = s.then(0.08);
    rest.pelvis.y -= 0.05;
  }
  BodyFrames frames = playKeys(
      studio.skeleton, s, {.hand_spread = 0.02, .angle_spread = 0.02, .heel_rise = 0.2, .hops = true}, studio.random);
  for (const Flight& flight : flights) fly(flight, frames);
  return {frames};
}

RawMotion hopOnOneLeg(Studio& studio) {
  KeyPose base = standing(0.07);
  base.right_foot = {.out = 0.10, .forward = -0.22, .lift = 0.25, .pitch = 0.7};
  base.pelvis.y = -0.05;
  setHands(base, {0.35, -0.25, 0.10, 0.2});
  std::vector<Flight> flights;
  KeySequence hops(base);
  hops.at(0.0);
  for (int i = 0; i < 5; ++i) {
    hops.base(0.22).pelvis.y = -0.11;
    KeyPose& off = hops.base(0.14);
    off.pelvis.y = 0.03;
    off.left_foot.pitch = 0.5;
    const double height = studio.uniform(0.04, 0.10);
    flights.push_back({off.time_s, height, 0.0, 0.0, studio.variant % 2 == 0 ? 0.0 : 0.2});
    KeyPose& down = hops.then(airTime(height));
    down.pelvis.y = -0.02;
    down.left_foot.pitch = 0.1;
  }
  hops.base(0.3);
  BodyFrames frames =
      playKeys(studio.skeleton, hops, {.hand_spread = 0.04, .angle_spread = 0.03, .heel_rise = 0.0}, studio.random);
  for (const Flight& flight : flights) fly(flight, frames);
  return {frames};
}

constexpr std::array kRecipes = {
    Recipe{"jump", 2, &jumpInPlace},        Recipe{"jump_tuck", 2, &jumpTuck}, Recipe{"jump_forward", 2, &jumpForward},
    Recipe{"jump_turn", 2, &jumpTurn},      Recipe{"jump_side", 2, &jumpSide}, Recipe{"jumping_jack", 3, &jumpingJack},
    Recipe{"hop_one_leg", 2, &hopOnOneLeg},
};

}  // namespace

std::span<const Recipe> jumpRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

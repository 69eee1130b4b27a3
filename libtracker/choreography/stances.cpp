#include <array>
#include <cmath>
#include <numbers>

#include "libtracker/choreography/easing.h"
#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Standing: postures held with small movement, shifting weight, looking and turning around.

namespace depthmocap {
namespace {

RawMotion hold(Studio& studio, const HandTarget& left, const HandTarget& right, double spread) {
  KeyPose pose = standing(studio.uniform(0.07, 0.20));
  pose.left = left;
  pose.right = right;
  pose.left_foot.toe_out = pose.right_foot.toe_out = studio.uniform(0.0, 0.3);
  KeySequence s(pose);
  s.at(0.0);
  for (int i = 0; i < 3; ++i) {
    KeyPose& key = s.base(1.0);
    key.pelvis.x = studio.uniform(-0.02, 0.02);
    key.head.turn = studio.uniform(-0.1, 0.1);
  }
  return {studio.play(s, spread)};
}

RawMotion tPose(Studio& studio) {
  return hold(studio, kTPose, kTPose, 0.012);
}
RawMotion aPose(Studio& studio) {
  return hold(studio, kAPose, kAPose, 0.015);
}
RawMotion handsOnHips(Studio& studio) {
  return hold(studio, kOnHip, kOnHip, 0.015);
}
RawMotion armsUp(Studio& studio) {
  return hold(studio, kOverhead, kOverhead, 0.03);
}
RawMotion armsForward(Studio& studio) {
  return hold(studio, kForward, kForward, 0.03);
}
RawMotion armsCrossed(Studio& studio) {
  return hold(studio, {-0.22, -0.24, 0.14, 0.25}, {-0.20, -0.19, 0.18, 0.25}, 0.012);
}
RawMotion handsFolded(Studio& studio) {
  return hold(studio, {-0.15, -0.42, 0.16, 0.1}, {-0.15, -0.42, 0.18, 0.1}, 0.015);
}
RawMotion handsBehindBack(Studio& studio) {
  return hold(studio, kBehindBack, kBehindBack, 0.01);
}
RawMotion handsBehindHead(Studio& studio) {
  return hold(studio, kBehindHead, kBehindHead, 0.015);
}
RawMotion handsUpBent(Studio& studio) {
  return hold(studio, {0.24, 0.24, 0.06, 0.0}, {0.24, 0.24, 0.06, 0.0}, 0.03);
}

// From the side to the T-pose and back, as before a calibration.
RawMotion intoTPose(Studio& studio) {
  KeySequence s(standing(studio.uniform(0.09, 0.18)));
  s.at(0.0);
  s.then(0.4);
  setHands(s.base(studio.uniform(0.8, 1.1)), kTPose);
  s.then(0.8);
  setHands(s.then(0.8), studio.variant % 2 == 0 ? kOverhead : kAPose);
  s.then(0.4);
  setHands(s.then(0.8), kTPose);
  s.then(0.4);
  s.base(1.0);
  return {studio.play(s, 0.012)};
}

// What an actor does for a calibration: hold the T-pose, then bend elbows and knees once, which shows where they are.
RawMotion calibrate(Studio& studio) {
  const HandTarget forearms_up{0.27, 0.24, 0.05, 0.0};
  const HandTarget forearms_forward{0.10, -0.27, 0.24, 0.0};
  KeySequence s(standing(studio.uniform(0.10, 0.14)));
  s.at(0.0);
  s.then(0.3);
  setHands(s.base(0.9), kTPose);
  for (int i = 0; i < 3; ++i) {
    KeyPose& key = s.then(0.7);
    key.pelvis.x = studio.uniform(-0.01, 0.01);
  }
  setHands(s.then(0.7), forearms_up);
  s.then(0.2);
  setHands(s.base(0.8), forearms_forward);
  s.then(0.2);
  for (const Side side : {Side::Left, Side::Right}) {
    KeyPose& key = s.then(0.7);
    (side == Side::Left ? key.left_foot : key.right_foot) = {
        .out = 0.10, .forward = 0.13, .lift = 0.40, .pitch = 0.4, .toe_out = 0.05};
    s.then(0.15);
    setHands(s.base(0.6), forearms_forward);
  }
  s.base(0.6);
  return {studio.play(s, 0.012)};
}

// Weight from leg to leg, hands finding new places.
RawMotion idle(Studio& studio) {
  static constexpr std::array kRest = {kAtSide,
                                       kAtSide,
                                       kOnHip,
                                       HandTarget{-0.15, -0.40, 0.17, 0.1},
                                       HandTarget{0.04, -0.46, 0.14, 0.2},
                                       HandTarget{-0.14, 0.10, 0.16, 0.1},
                                       kBehindBack};
  KeySequence s(standing(studio.uniform(0.09, 0.15)));
  s.at(0.0);
  for (int i = 0; i < 6; ++i) {
    KeyPose& key = s.base(studio.uniform(0.8, 1.3));
    const double side = studio.uniform(-1.0, 1.0);
    key.pelvis.x = 0.07 * side;
    key.pelvis.held = 0.6;
    key.pelvis.tilt = -0.07 * side;
    key.spine.side = 0.10 * side;
    key.pelvis.heading = studio.uniform(-0.2, 0.2);
    key.right = kRest[studio.random.below(kRest.size())];
    key.left = kRest[studio.random.below(kRest.size())];
    key.head = {studio.uniform(-0.15, 0.25), studio.uniform(-0.1, 0.1), studio.uniform(-0.7, 0.7)};
  }
  return {studio.play(s, 0.02)};
}

RawMotion lookAround(Studio& studio) {
  KeySequence s(standing());
  s.at(0.0);
  for (int i = 0; i < 7; ++i) {
    const double turn = studio.uniform(-1.25, 1.25);
    KeyPose& key = s.base(studio.uniform(0.45, 0.8));
    key.head = {studio.uniform(-0.6, 0.7), studio.uniform(-0.35, 0.35), turn};
    key.spine.twist = 0.35 * turn;
    key.pelvis.heading = 0.15 * turn;
    s.then(studio.uniform(0.15, 0.5));
  }
  return {studio.play(s, 0.02)};
}

// On the spot, by small steps, with pauses.
RawMotion turnAround(Studio& studio) {
  static constexpr std::array kTurns = {std::numbers::pi / 2, std::numbers::pi, 2 * std::numbers::pi};
  const double angle = kTurns[static_cast<std::size_t>(studio.variant) % kTurns.size()];
  const double turn_s = 0.9 + 0.75 * angle;
  const auto path = [=](double t) { return PathPoint{0, 0, angle * smoothStep((t - 0.6) / turn_s)}; };
  GaitStyle style;
  style.cycle_s = studio.uniform(1.0, 1.2);
  style.foot_roll = 0.5;
  style.clearance = 0.045;
  style.passes_early = 0.0;
  style.half_width = 0.10;
  style.arm_swing = 0.12;
  return {walkAlong(path, turn_s + 1.4, style, studio.random.uniform())};
}

constexpr std::array kRecipes = {
    Recipe{"t_pose", 3, &tPose},
    Recipe{"a_pose", 2, &aPose},
    Recipe{"hands_on_hips", 2, &handsOnHips},
    Recipe{"arms_up", 2, &armsUp},
    Recipe{"arms_forward", 1, &armsForward},
    Recipe{"arms_crossed", 2, &armsCrossed},
    Recipe{"hands_folded", 1, &handsFolded},
    Recipe{"hands_behind_back", 2, &handsBehindBack},
    Recipe{"hands_behind_head", 2, &handsBehindHead},
    Recipe{"hands_up_bent", 2, &handsUpBent},
    Recipe{"into_t_pose", 2, &intoTPose},
    Recipe{"calibrate", 1, &calibrate},
    Recipe{"idle", 3, &idle},
    Recipe{"look_around", 2, &lookAround},
    Recipe{"turn_around", 3, &turnAround},
};

}  // namespace

std::span<const Recipe> stanceRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

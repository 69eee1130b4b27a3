#include <algorithm>
#include <array>
#include <cmath>

#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Work about the house, things picked up and carried, stairs and ladders.

namespace depthmocap {
namespace {

// Down to the floor: bent hips, bent knees, or between; `depth` [0, 1] from the hips to the knees.
void bendDown(KeyPose& key, double depth) {
  key.pelvis.y = -0.12 - 0.36 * depth;
  key.pelvis.lean = 1.15 - 0.25 * depth;
  key.spine.bend = 0.55 - 0.10 * depth;
  key.head.nod = -0.25;
}

RawMotion pickUp(Studio& studio, bool throws) {
  KeySequence s(standing(studio.uniform(0.11, 0.18)));
  s.at(0.0);
  for (int i = 0; i < 2; ++i) {
    const double depth = studio.uniform(0.0, 1.0);
    const bool both = studio.chance(0.5);
    KeyPose& down = s.base(studio.uniform(0.8, 1.1));
    bendDown(down, depth);
    down.right = {studio.uniform(-0.10, 0.05), studio.uniform(-0.20, -0.05), 0.49, 0.0};
    down.left = both ? down.right : HandTarget{0.04, -0.34, 0.22, 0.2};
    if (!both) down.spine.twist = 0.25;
    s.then(0.25);
    KeyPose& up = s.base(studio.uniform(0.7, 1.0));
    up.right = kBeforeBelly;
    if (both) up.left = kBeforeBelly;
    if (throws) {
      KeyPose& back = s.then(0.5);
      back.right = {0.28, 0.22, -0.12, 0.0};
      back.left = {0.05, 0.0, 0.45, 0.1};
      back.spine = {.bend = -0.1, .twist = -0.45};
      back.pelvis.heading = -0.35;
      KeyPose& release = s.base(0.24);
      release.right = {0.0, 0.36, 0.40, 0.0};
      release.spine.twist = 0.25;
      KeyPose& through = s.base(0.22);
      through.right = {-0.20, -0.20, 0.40, 0.0};
      through.spine = {.bend = 0.3, .twist = 0.4};
    } else {
      s.then(0.4);
    }
    s.base(0.7);
  }
  return {studio.play(s)};
}
RawMotion pickUpOnly(Studio& studio) {
  return pickUp(studio, false);
}
RawMotion pickUpAndThrow(Studio& studio) {
  return pickUp(studio, true);
}

RawMotion bend(Studio& studio) {
  KeySequence s(standing(studio.uniform(0.10, 0.2)));
  s.at(0.0);
  for (int i = 0; i < 2; ++i) {
    KeyPose& down = s.base(studio.uniform(0.7, 1.0));
    down.pelvis.lean = studio.uniform(0.6, 1.1);
    down.spine.bend = studio.uniform(0.4, 0.8);
    down.pelvis.y = -0.05;
    down.head.nod = studio.uniform(-0.2, 0.3);
    down.right = {studio.uniform(-0.1, 0.1), studio.uniform(-0.40, -0.05), 0.45, 0.0};
    down.left = {studio.uniform(-0.1, 0.1), studio.uniform(-0.40, -0.05), 0.45, 0.0};
    s.then(studio.uniform(0.2, 0.5));
    s.base(studio.uniform(0.7, 1.0));
    s.then(0.2);
  }
  return {studio.play(s)};
}

RawMotion tieShoe(Studio& studio) {
  KeySequence s(standing());
  s.at(0.0);
  KeyPose down = standing();
  down.left_foot = {.out = 0.12, .forward = 0.28};
  down.right_foot = {.out = 0.12, .forward = -0.30, .pitch = 0.95};
  down.pelvis.y = -0.40;
  down.pelvis.lean = 0.55;
  down.spine.bend = 0.55;
  down.head.nod = 0.2;
  down.left = {-0.08, -0.26, 0.40, 0.0};
  down.right = {-0.24, -0.26, 0.36, 0.0};
  s.add(down, 1.1);
  for (int i = 0; i < 4; ++i) {
    KeyPose& tie = s.then(0.4);
    tie.left.up += i % 2 == 0 ? 0.08 : -0.08;
    tie.right.up += i % 2 == 0 ? 0.08 : -0.08;
  }
  s.base(1.1);
  return {studio.play(s, 0.02)};
}

RawMotion hammer(Studio& studio) {
  KeyPose base = standing(0.16);
  base.left_foot.forward = 0.10;
  base.left = studio.variant % 2 == 0 ? HandTarget{-0.08, -0.16, 0.40, 0.1} : kAtSide;
  base.spine.bend = 0.1;
  KeySequence s(base);
  s.at(0.0);
  const double top = studio.uniform(0.15, 0.42);
  for (int i = 0; i < 6; ++i) {
    KeyPose& up = s.base(studio.uniform(0.38, 0.5));
    up.right = {studio.uniform(0.02, 0.14), top, 0.10, 0.0};
    up.spine.bend = 0.0;
    KeyPose& hit = s.base(studio.uniform(0.2, 0.26));
    hit.right = {-0.08, studio.uniform(-0.30, -0.15), 0.42, 0.0};
    hit.spine.bend = 0.22;
    hit.head.nod = 0.2;
  }
  s.base(0.6);
  return {studio.play(s)};
}

// Both hands on a stick that is pushed and drawn over the floor.
RawMotion mop(Studio& studio) {
  KeyPose base = standing(0.16);
  base.left_foot.forward = 0.14;
  base.right_foot.forward = -0.12;
  base.pelvis.lean = 0.25;
  base.spine.bend = 0.3;
  base.pelvis.y = -0.06;
  base.head.nod = 0.2;
  KeySequence s(base);
  for (int i = 0; i < 10; ++i) {
    KeyPose& key = i == 0 ? s.at(0.0) : s.base(studio.uniform(0.45, 0.65));
    const bool pushes = i % 2 == 0;
    const double aside = studio.uniform(-0.12, 0.12);
    key.right = {pushes ? -0.10 : 0.06, pushes ? -0.18 : -0.22, pushes ? 0.36 : 0.16, 0.2};
    key.left = {pushes ? -0.16 : -0.06, pushes ? -0.38 : -0.40, pushes ? 0.36 : 0.20, 0.1};
    key.pelvis.lean = pushes ? 0.35 : 0.18;
    key.spine.twist = aside + (pushes ? 0.2 : -0.15);
    key.pelvis.heading = aside;
    key.pelvis.z = pushes ? 0.05 : -0.02;
  }
  return {studio.play(s)};
}

RawMotion reachShelf(Studio& studio) {
  KeySequence s(standing(0.13));
  s.at(0.0);
  for (int i = 0; i < 2; ++i) {
    KeyPose& high = s.base(studio.uniform(0.7, 0.9));
    high.right = {studio.uniform(-0.15, 0.25), studio.uniform(0.30, 0.56), studio.uniform(0.15, 0.35), 0.0};
    if (studio.chance(0.5)) high.left = high.right;
    high.head.nod = -0.35;
    high.spine = {.bend = -0.12, .side = 0.08};
    high.left_foot.pitch = high.right_foot.pitch = studio.uniform(0.0, 0.5);
    high.pelvis.y = 0.03;
    s.then(0.35);
    KeyPose& low = s.base(0.8);
    low.right = {studio.uniform(-0.1, 0.2), studio.uniform(-0.3, 0.0), 0.40, 0.0};
    low.head.nod = 0.2;
    s.then(0.2);
    s.base(0.6);
  }
  return {studio.play(s)};
}

RawMotion push(Studio& studio) {
  KeyPose base = standing(0.14);
  base.left_foot.forward = 0.30;
  base.right_foot.forward = -0.30;
  base.right_foot.pitch = 0.35;
  base.pelvis.y = -0.12;
  KeySequence s(base);
  s.at(0.0);
  for (int i = 0; i < 4; ++i) {
    KeyPose& near = s.base(studio.uniform(0.5, 0.7));
    setHands(near, {0.02, -0.06, 0.18, 0.2});
    near.pelvis.z = -0.05;
    KeyPose& away = s.base(studio.uniform(0.5, 0.7));
    setHands(away, {0.0, -0.02, 0.52, 0.1});
    away.pelvis.lean = 0.3;
    away.pelvis.z = 0.08;
    away.spine.bend = 0.15;
  }
  return {studio.play(s)};
}

RawMotion carryWalk(Studio& studio) {
  GaitStyle style;
  const double v = studio.uniform(0.7, 1.1);
  style.cycle_s = 1.2;
  const double turn_rate = studio.uniform(-0.4, 0.4);
  BodyFrames frames = walkAlong(straightPath(v, 0, turn_rate), 4.0, style, studio.random.uniform());
  KeyPose key;
  switch (studio.variant % 4) {
    case 0:
      setHands(key, {-0.04, -0.24, 0.30, 0.1});  // a box
      break;
    case 1:
      key.right = {-0.05, 0.24, 0.08, 0.2};  // a phone
      break;
    case 2:
      key.right = {0.05, 0.20, 0.12, 0.1};  // something on the shoulder
      key.left = {-0.12, -0.10, 0.30, 0.1};
      break;
    default:
      setHands(key, {0.02, 0.46, 0.06, 0.1});  // on the head
      break;
  }
  KeySequence s(key);
  s.at(0.0);
  for (int i = 0; i < 5; ++i) s.then(1.0);
  overlayUpperBody(studio.play(s, 0.015), frames);
  return {frames};
}

RawMotion walkAndWave(Studio& studio) {
  const double v = studio.uniform(0.8, 1.2);
  BodyFrames frames = walkAlong(straightPath(v), 4.0, GaitStyle{}, studio.random.uniform());
  KeySequence s(standing());
  s.at(0.0);
  const bool both = studio.variant % 2 == 1;
  for (int i = 0; i < 10; ++i) {
    KeyPose& key = s.base(0.45);
    key.right = {i % 2 == 0 ? 0.0 : 0.30, 0.36, 0.16, 0.2};
    if (both) key.left = key.right;
    key.head.turn = -0.2;
  }
  overlayUpperBody(studio.play(s, 0.02), frames);
  return {frames};
}

RawMotion stairs(Studio& studio, double rise) {
  constexpr double kTread = 0.29;  // [m]
  GaitStyle style;
  style.cycle_s = studio.uniform(1.3, 1.5);
  style.clearance = 0.08;
  style.foot_roll = 0.35;
  style.swing_carry = 0.0;
  style.lean = rise > 0 ? 0.15 : 0.04;
  style.bounce = 0.0;
  style.arm_swing = 0.2;
  const double speed = 2.0 * kTread / style.cycle_s;
  constexpr double kDuration = 4.5;  // [s]
  const double first = rise > 0 ? 0.0 : -rise * std::ceil(speed * kDuration / kTread + 2.0);
  const auto ground = [=](double, double z) { return first + rise * std::max(0.0, std::floor(z / kTread)); };
  return {walkAlong(straightPath(speed), kDuration, style, studio.random.uniform(), ground)};
}
RawMotion stairsUp(Studio& studio) {
  return stairs(studio, 0.17);
}
RawMotion stairsDown(Studio& studio) {
  return stairs(studio, -0.17);
}

// Hand over hand, foot over foot.
RawMotion climbLadder(Studio& studio) {
  constexpr double kRung = 0.28;  // [m]
  KeyPose base = standing(0.10);
  base.pelvis.held = 1.0;
  base.pelvis.z = -0.22;
  base.pelvis.y = -0.14;
  base.left_foot.toe_out = base.right_foot.toe_out = 0.05;
  base.head.nod = -0.3;
  const HandTarget high{0.02, 0.42, 0.28, 0.0};
  const HandTarget low{0.02, 0.10, 0.30, 0.0};
  KeySequence s(base);
  KeyPose now = base;
  now.left = low;
  now.right = high;
  s.at(0.0);
  s.add(now, 0.7);
  for (int i = 0; i < 6; ++i) {
    const bool left = i % 2 == 0;
    (left ? now.left : now.right) = high;
    (left ? now.right : now.left) = low;
    (left ? now.left_foot : now.right_foot).ground = kRung * (i + 1);
    now.pelvis.y = base.pelvis.y + kRung * (i + 0.4);
    now.pelvis.tilt = left ? -0.06 : 0.06;
    now.spine.side = left ? 0.08 : -0.08;
    s.add(now, studio.uniform(0.7, 0.85));
  }
  return {studio.play(s, 0.015)};
}

constexpr std::array kRecipes = {
    Recipe{"pick_up", 3, &pickUpOnly},
    Recipe{"pick_up_and_throw", 2, &pickUpAndThrow},
    Recipe{"bend", 2, &bend},
    Recipe{"tie_shoe", 2, &tieShoe},
    Recipe{"hammer", 2, &hammer},
    Recipe{"mop", 2, &mop},
    Recipe{"reach_shelf", 2, &reachShelf},
    Recipe{"push", 2, &push},
    Recipe{"walk_carry", 4, &carryWalk},
    Recipe{"walk_wave", 2, &walkAndWave},
    Recipe{"stairs_up", 2, &stairsUp},
    Recipe{"stairs_down", 2, &stairsDown},
    Recipe{"climb_ladder", 2, &climbLadder},
};

}  // namespace

std::span<const Recipe> everydayRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

#include <array>

#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Gymnastics: squats, lunges, balance, stretching, bending and twisting the trunk.

namespace depthmocap {
namespace {

RawMotion squat(Studio& studio) {
  const double width = studio.uniform(0.13, 0.22);
  KeySequence s(standing(width));
  s.at(0.0);
  for (int i = 0; i < 3; ++i) {
    const double depth = studio.uniform(0.20, 0.46);
    KeyPose& down = s.base(studio.uniform(0.7, 1.0));
    down.pelvis.y = -depth;
    down.pelvis.lean = 0.2 + 0.9 * depth;
    down.spine.bend = 0.15;
    down.head.nod = -0.3;
    down.left_foot.knee_out = down.right_foot.knee_out = 0.15;
    switch (studio.variant % 4) {
      case 0:
        setHands(down, {0.0, 0.26, 0.48, 0.1});
        break;
      case 1:
        setHands(down, kBeforeChest);
        break;
      case 2:
        setHands(down, {0.06, 0.54, 0.08, 0.0});
        break;
      default:
        setHands(down, kBehindHead);
        break;
    }
    s.then(0.15);
    s.base(studio.uniform(0.6, 0.9));
  }
  return {studio.play(s, 0.02)};
}

RawMotion lunge(Studio& studio) {
  KeySequence s(standing(0.10));
  s.at(0.0);
  const HandTarget hands = studio.variant % 2 == 0 ? kOnHip : HandTarget{0.45, 0.02, 0.10, 0.0};
  for (int i = 0; i < 2; ++i) {
    KeyPose& low = s.base(studio.uniform(0.75, 0.95));
    FootKey& front = i % 2 == 0 ? low.left_foot : low.right_foot;
    FootKey& rear = i % 2 == 0 ? low.right_foot : low.left_foot;
    front.forward = studio.uniform(0.55, 0.70);
    rear.pitch = 0.85;
    rear.toe_out = 0.0;
    low.pelvis.y = -studio.uniform(0.22, 0.36);
    low.pelvis.z = 0.30;
    setHands(low, hands);
    s.then(0.3);
    s.base(studio.uniform(0.75, 0.95));
    s.then(0.15);
  }
  return {studio.play(s, 0.02)};
}

RawMotion sideLunge(Studio& studio) {
  KeySequence s(standing(0.12));
  s.at(0.0);
  for (int i = 0; i < 2; ++i) {
    KeyPose& low = s.base(studio.uniform(0.75, 0.95));
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    (side > 0 ? low.left_foot : low.right_foot).out = studio.uniform(0.55, 0.75);
    (side > 0 ? low.left_foot : low.right_foot).toe_out = 0.35;
    low.pelvis.x = 0.26 * side;
    low.pelvis.held = 0.8;
    low.pelvis.y = -studio.uniform(0.18, 0.32);
    low.pelvis.lean = 0.35;
    low.spine.side = 0.1 * side;
    setHands(low, studio.variant % 2 == 0 ? kBeforeChest : kForward);
    s.then(0.3);
    s.base(studio.uniform(0.75, 0.95));
    s.then(0.15);
  }
  return {studio.play(s, 0.02)};
}

RawMotion balanceOneLeg(Studio& studio) {
  static constexpr std::array<FootKey, 5> kFree = {
      {{.out = 0.05, .forward = 0.12, .lift = 0.40, .pitch = 0.3},
       {.out = 0.10, .forward = -0.40, .lift = 0.45, .pitch = 0.9},
       {.out = 0.55, .forward = 0.0, .lift = 0.25, .pitch = 0.2},
       {.out = 0.10, .forward = 0.55, .lift = 0.30, .pitch = 0.1},
       {.out = -0.02, .forward = 0.02, .lift = 0.45, .pitch = 0.4, .toe_out = 1.0, .knee_out = 0.6}}};
  KeySequence s(standing(0.10));
  s.at(0.0);
  s.then(0.4);
  for (int i = 0; i < 2; ++i) {
    const std::size_t kind = studio.random.below(kFree.size());
    KeyPose& key = s.base(studio.uniform(0.9, 1.2));
    key.right_foot = kFree[kind];
    key.left_foot.toe_out = 0.1;
    if (kind == 1) key.pelvis.lean = studio.uniform(0.2, 0.8);
    if (kind == 2) key.pelvis.tilt = -0.15;
    setHands(key, {0.48, studio.uniform(-0.1, 0.2), 0.08, 0.0});
    for (int wobble = 0; wobble < 3; ++wobble) {
      KeyPose& next = s.then(0.4);
      next.spine.side = studio.uniform(-0.08, 0.08);
      next.left.up += studio.uniform(-0.08, 0.08);
      next.right.up += studio.uniform(-0.08, 0.08);
    }
    s.base(0.9);
    s.then(0.3);
  }
  return {studio.play(s, 0.02)};
}

RawMotion kneeRaises(Studio& studio) {
  KeySequence s(standing(0.09));
  s.at(0.0);
  for (int i = 0; i < 6; ++i) {
    KeyPose& key = s.base(studio.uniform(0.45, 0.6));
    FootKey& foot = i % 2 == 0 ? key.right_foot : key.left_foot;
    foot = {.out = 0.09, .forward = 0.12, .lift = studio.uniform(0.3, 0.5), .pitch = 0.5, .toe_out = 0.05};
    (i % 2 == 0 ? key.left : key.right) =
        studio.variant == 0 ? HandTarget{-0.05, -0.10, 0.35, 0.0} : HandTarget{0.0, 0.55, 0.1, 0.0};
    key.spine.bend = 0.15;
    key.spine.twist = i % 2 == 0 ? -0.2 : 0.2;
    s.base(studio.uniform(0.45, 0.6));
  }
  return {studio.play(s, 0.02)};
}

RawMotion legSwings(Studio& studio) {
  KeySequence s(standing(0.10));
  s.at(0.0);
  s.then(0.3);
  const bool aside = studio.variant % 2 == 1;
  for (int i = 0; i < 3; ++i) {
    KeyPose& out = s.base(studio.uniform(0.5, 0.65));
    out.right_foot =
        aside ? FootKey{.out = 0.60, .lift = 0.25, .pitch = 0.2} : FootKey{.out = 0.10, .forward = 0.55, .lift = 0.30};
    setHands(out, kOnHip);
    KeyPose& back = s.base(studio.uniform(0.5, 0.65));
    back.right_foot = aside ? FootKey{.out = -0.25, .forward = 0.18, .lift = 0.06}
                            : FootKey{.out = 0.10, .forward = -0.40, .lift = 0.18, .pitch = 0.6};
    setHands(back, kOnHip);
    back.pelvis.lean = aside ? 0.0 : 0.15;
  }
  s.base(0.7);
  return {studio.play(s, 0.02)};
}

// One trunk posture after the other, hands as given.
RawMotion trunkExercise(Studio& studio, std::span<const KeyPose> postures, double beat_s, int rounds) {
  KeySequence s(standing(0.18));
  s.at(0.0);
  for (int i = 0; i < rounds; ++i) {
    for (const KeyPose& pose : postures) {
      KeyPose& key = s.add(pose, studio.near(beat_s, 0.12));
      key.left_foot.out = key.right_foot.out = 0.18;
      s.then(0.2);
    }
  }
  s.base(0.8);
  return {studio.play(s, 0.02)};
}

RawMotion sideBends(Studio& studio) {
  KeyPose left;
  left.left = studio.variant % 2 == 0 ? kOnHip : HandTarget{0.10, -0.52, 0.05, 0.0};
  left.right = {-0.10, 0.56, 0.05, 0.2};
  left.spine.side = -0.5;
  left.pelvis.tilt = -0.12;
  KeyPose right = left;
  std::swap(right.left, right.right);
  right.spine.side = 0.5;
  right.pelvis.tilt = 0.12;
  return trunkExercise(studio, std::array{left, right}, 0.9, 1);
}

RawMotion trunkTwists(Studio& studio) {
  KeyPose left;
  setHands(left, studio.variant % 2 == 0 ? HandTarget{0.50, 0.0, 0.06, 0.0} : kBeforeChest);
  left.spine.twist = 0.7;
  left.pelvis.heading = 0.3;
  left.head.turn = 0.4;
  KeyPose right = left;
  right.spine.twist = -0.7;
  right.pelvis.heading = -0.3;
  right.head.turn = -0.4;
  return trunkExercise(studio, std::array{left, right}, 0.7, 2);
}

RawMotion toeTouch(Studio& studio) {
  KeyPose up;
  setHands(up, {0.08, 0.56, 0.02, 0.0});
  up.spine.bend = -0.15;
  KeyPose down;
  down.pelvis.lean = studio.uniform(0.9, 1.15);
  down.spine.bend = studio.uniform(0.7, 1.0);
  down.head.nod = 0.2;
  setHands(down, kToFloor);
  KeyPose crossed = down;
  crossed.spine.twist = 0.5;
  crossed.right = {-0.18, -0.10, 0.48, 0.0};
  crossed.left = {0.42, 0.05, -0.25, 0.0};
  if (studio.variant % 2 == 0) return trunkExercise(studio, std::array{up, down}, 0.95, 2);
  return trunkExercise(studio, std::array{up, crossed}, 0.95, 2);
}

RawMotion stretch(Studio& studio) {
  KeyPose up;
  setHands(up, {-0.14, 0.58, 0.02, 0.0});
  up.left_foot.pitch = up.right_foot.pitch = 0.4;
  up.pelvis.y = 0.03;
  up.head.nod = -0.3;
  up.spine.bend = -0.2;
  KeyPose across;  // one arm pulled across the chest
  across.right = {-0.30, -0.02, 0.30, 0.2};
  across.left = {-0.02, -0.10, 0.26, 0.3};
  across.spine.twist = 0.2;
  KeyPose behind;  // hands joined behind the back
  setHands(behind, kBehindBack);
  behind.spine.bend = -0.15;
  KeyPose triceps;  // the hand down between the shoulder blades
  triceps.right = {-0.02, 0.16, -0.12, 0.3};
  triceps.left = {-0.12, 0.34, 0.02, 0.3};
  KeyPose wide;
  setHands(wide, {0.46, 0.16, -0.14, 0.0});
  wide.spine.bend = -0.15;
  return trunkExercise(studio, std::array{up, across, wide, behind, triceps}, 1.1, 1);
}

RawMotion hipCircles(Studio& studio) {
  KeyPose base;
  setHands(base, kOnHip);
  std::array<KeyPose, 4> around = {base, base, base, base};
  around[0].pelvis.z = 0.08;
  around[0].spine.bend = -0.2;
  around[1].pelvis.x = 0.09;
  around[1].pelvis.tilt = -0.1;
  around[1].spine.side = 0.2;
  around[2].pelvis.z = -0.10;
  around[2].pelvis.lean = 0.25;
  around[3].pelvis.x = -0.09;
  around[3].pelvis.tilt = 0.1;
  around[3].spine.side = -0.2;
  for (KeyPose& key : around) key.pelvis.held = 1.0;
  return trunkExercise(studio, around, 0.35, 2);
}

constexpr std::array kRecipes = {
    Recipe{"squat", 4, &squat},
    Recipe{"lunge", 2, &lunge},
    Recipe{"lunge_side", 2, &sideLunge},
    Recipe{"balance_one_leg", 3, &balanceOneLeg},
    Recipe{"knee_raises", 2, &kneeRaises},
    Recipe{"leg_swings", 2, &legSwings},
    Recipe{"side_bends", 2, &sideBends},
    Recipe{"trunk_twists", 2, &trunkTwists},
    Recipe{"toe_touch", 2, &toeTouch},
    Recipe{"stretch", 2, &stretch},
    Recipe{"hip_circles", 2, &hipCircles},
};

}  // namespace

std::span<const Recipe> exerciseRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

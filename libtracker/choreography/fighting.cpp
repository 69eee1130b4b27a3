#include <array>

#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Boxing, kicking and blows with a weapon.

namespace depthmocap {
namespace {

// Each blow starts and ends in the guard; what differs from the guard is given for the moment of the hit.
using Blow = void (*)(Studio&, KeySequence&);

void hit(KeySequence& s, double there_s, double back_s, const KeyPose& at_hit) {
  s.add(at_hit, there_s);
  s.then(0.06);
  s.base(back_s);
}

void jab(Studio& studio, KeySequence& s) {
  KeyPose key = boxingGuard();
  key.left = {studio.uniform(-0.14, -0.06), studio.uniform(0.0, 0.12), 0.55, 0.1};
  key.spine.twist = -0.25;
  key.pelvis.z = 0.05;
  hit(s, 0.18, 0.26, key);
}

void cross(Studio& studio, KeySequence& s) {
  KeyPose key = boxingGuard();
  key.right = {studio.uniform(-0.14, -0.04), studio.uniform(0.0, 0.12), 0.56, 0.1};
  key.pelvis.heading = -0.05;
  key.spine.twist = 0.45;
  key.head.turn = -0.30;
  key.pelvis.z = 0.08;
  key.right_foot.pitch = 0.5;
  hit(s, 0.22, 0.32, key);
}

void hook(Studio& studio, KeySequence& s) {
  KeyPose& back = s.base(0.18);
  back.left = {0.28, -0.05, 0.25, 0.7};
  back.spine.twist = 0.35;
  KeyPose key = boxingGuard();
  key.left = {studio.uniform(-0.20, -0.10), 0.05, 0.36, 1.1};
  key.pelvis.heading = -0.85;
  key.spine.twist = -0.35;
  key.head.turn = 0.9;
  hit(s, 0.18, 0.34, key);
}

void uppercut(Studio& studio, KeySequence& s) {
  KeyPose& low = s.base(0.20);
  low.right = {0.02, -0.30, 0.20, -0.1};
  low.pelvis.y = -0.14;
  low.spine = {.bend = 0.25, .twist = -0.25, .side = 0.15};
  KeyPose key = boxingGuard();
  key.right = {-0.10, studio.uniform(0.08, 0.22), 0.34, -0.2};
  key.pelvis.heading = -0.1;
  key.pelvis.y = -0.03;
  key.spine = {.bend = 0.0, .twist = 0.35};
  hit(s, 0.20, 0.34, key);
}

void bodyPunch(Studio& studio, KeySequence& s) {
  KeyPose key = boxingGuard();
  key.pelvis.y = -0.22;
  key.pelvis.lean = 0.25;
  key.right = {-0.10, studio.uniform(-0.22, -0.12), 0.52, 0.0};
  key.spine.twist = 0.35;
  hit(s, 0.26, 0.36, key);
}

void duck(Studio& studio, KeySequence& s) {
  KeyPose& low = s.base(0.28);
  low.pelvis.y = -studio.uniform(0.2, 0.32);
  low.pelvis.lean = 0.3;
  low.spine.bend = 0.4;
  low.spine.side = studio.uniform(-0.3, 0.3);
  s.base(0.3);
}

void shuffle(Studio& studio, KeySequence& s) {
  const double way = studio.uniform(-0.12, 0.12);
  KeyPose& step = s.base(0.22);
  step.left_foot.forward += way;
  step.pelvis.z = 0.5 * way;
  KeyPose& follow = s.then(0.2);
  follow.right_foot.forward += way;
  follow.pelvis.z = way;
  s.then(0.2).left_foot.forward -= way;
  s.base(0.2);
}

constexpr std::array<Blow, 7> kBlows = {&jab, &cross, &hook, &uppercut, &bodyPunch, &duck, &shuffle};

RawMotion repeat(Studio& studio, Blow blow, int count) {
  KeySequence s(boxingGuard());
  s.at(0.0);
  for (int i = 0; i < count; ++i) {
    blow(studio, s);
    s.base(studio.uniform(0.1, 0.35));
  }
  return {studio.play(s)};
}

RawMotion boxJab(Studio& studio) {
  return repeat(studio, &jab, 5);
}
RawMotion boxCross(Studio& studio) {
  return repeat(studio, &cross, 4);
}
RawMotion boxHook(Studio& studio) {
  return repeat(studio, &hook, 4);
}
RawMotion boxUppercut(Studio& studio) {
  return repeat(studio, &uppercut, 4);
}

RawMotion shadowBox(Studio& studio) {
  KeySequence s(boxingGuard());
  s.at(0.0);
  for (int i = 0; i < 9; ++i) {
    kBlows[studio.random.below(kBlows.size())](studio, s);
    if (studio.chance(0.4)) s.base(studio.uniform(0.1, 0.4));
  }
  return {studio.play(s, 0.035)};
}

// Standing square, one fist after the other straight ahead; or to the side, looking there.
RawMotion punches(Studio& studio, double turn) {
  KeyPose base = standing(0.16);
  base.pelvis.y = -0.05;
  setHands(base, {-0.02, -0.20, 0.14, 0.0});
  base.head.turn = turn;
  base.spine.twist = 0.3 * turn;
  KeySequence s(base);
  s.at(0.0);
  for (int i = 0; i < 5; ++i) {
    KeyPose& out = s.base(studio.uniform(0.25, 0.4));
    HandTarget& hand = (turn != 0 || i % 2 == 0) ? out.right : out.left;
    if (turn != 0) {
      hand = {0.50, studio.uniform(-0.08, 0.15), 0.20, 0.2};
    } else {
      hand = {studio.uniform(-0.12, 0.0), studio.uniform(-0.1, 0.15), 0.55, 0.1};
      out.spine.twist = i % 2 == 0 ? 0.35 : -0.35;
    }
    s.then(0.07);
    s.base(studio.uniform(0.3, 0.5));
  }
  return {studio.play(s)};
}
RawMotion punchForward(Studio& studio) {
  return punches(studio, 0.0);
}
RawMotion punchSideways(Studio& studio) {
  return punches(studio, -0.9);
}

RawMotion block(Studio& studio) {
  KeySequence s(boxingGuard());
  s.at(0.0);
  for (int i = 0; i < 5; ++i) {
    KeyPose& key = s.base(studio.uniform(0.2, 0.3));
    const bool high = studio.chance(0.5);
    HandTarget& hand = studio.chance(0.5) ? key.left : key.right;
    hand = high ? HandTarget{-0.06, 0.28, 0.24, 0.8} : HandTarget{0.12, -0.32, 0.28, 0.2};
    key.pelvis.y = high ? -0.08 : -0.14;
    s.then(0.25);
    s.base(0.3);
  }
  return {studio.play(s)};
}

// A kick: chambered knee, the foot's way out, back. `chamber` and `hit` are the kicking right foot.
struct Kick {
  FootKey chamber, hit, retract;
  PelvisState body;  // at the hit
  SpineState spine;
  HandTarget left, right;
  double stand_toe_out = 0.15;
};

RawMotion kicks(Studio& studio, const KeyPose& base, const Kick& kick) {
  KeyPose ready = base;
  ready.left_foot.toe_out = kick.stand_toe_out;
  KeySequence s(ready);
  s.at(0.0) = base;
  s.base(0.4);
  for (int i = 0; i < 2; ++i) {
    const double height = studio.uniform(0.75, 1.1);
    KeyPose& chamber = s.base(studio.uniform(0.32, 0.42));
    chamber.right_foot = kick.chamber;
    chamber.pelvis = kick.body;
    chamber.pelvis.heading = 0.5 * (base.pelvis.heading + kick.body.heading);
    chamber.pelvis.lean *= 0.4;
    chamber.pelvis.tilt *= 0.4;
    chamber.pelvis.y = -0.03;
    KeyPose& hit = s.then(studio.uniform(0.22, 0.28));
    hit.right_foot = kick.hit;
    hit.right_foot.lift *= height;
    hit.pelvis = kick.body;
    hit.spine = kick.spine;
    hit.left = kick.left;
    hit.right = kick.right;
    s.then(0.06);
    KeyPose& back = s.then(0.30);
    back.right_foot = kick.retract;
    back.pelvis.lean *= 0.4;
    back.pelvis.tilt *= 0.4;
    s.base(0.40);
    s.base(studio.uniform(0.15, 0.5));
  }
  s.add(base, 0.4);
  return {studio.play(s, 0.025)};
}

KeyPose kickStance(Studio& studio) {
  if (studio.variant % 3 < 2) return standing(0.12);
  KeyPose base = boxingGuard();
  base.right_foot.pitch = 0.0;
  return base;
}

RawMotion kickForward(Studio& studio) {
  return kicks(studio, kickStance(studio),
               {.chamber = {.out = 0.09, .forward = 0.14, .lift = 0.42, .pitch = 0.5, .toe_out = 0.05},
                .hit = {.out = 0.05, .forward = 0.72, .lift = 0.72, .pitch = -0.5, .toe_out = 0.05},
                .retract = {.out = 0.09, .forward = 0.18, .lift = 0.40, .pitch = 0.4, .toe_out = 0.05},
                .body = {.y = -0.02, .lean = -0.18},
                .spine = {.bend = 0.15, .twist = 0.15},
                .left = {0.15, -0.25, 0.35, 0.0},
                .right = {0.22, -0.38, -0.12, 0.1}});
}

RawMotion kickSide(Studio& studio) {
  return kicks(studio, kickStance(studio),
               {.chamber = {.out = 0.28, .forward = 0.12, .lift = 0.42, .pitch = 0.2, .toe_out = 0.1},
                .hit = {.out = 0.80, .forward = 0.05, .lift = 0.68, .pitch = 0.0, .toe_out = 0.1},
                .retract = {.out = 0.30, .forward = 0.12, .lift = 0.38, .pitch = 0.2, .toe_out = 0.1},
                .body = {.y = -0.02, .heading = 0.25, .tilt = -0.42},
                .spine = {.side = 0.15},
                .left = {0.05, -0.10, 0.30, 0.0},
                .right = {0.20, -0.35, 0.05, 0.2},
                .stand_toe_out = 0.7});
}

RawMotion kickRoundhouse(Studio& studio) {
  return kicks(studio, kickStance(studio),
               {.chamber = {.out = 0.38, .forward = -0.10, .lift = 0.45, .pitch = 0.6, .toe_out = -0.3},
                .hit = {.out = -0.05, .forward = 0.74, .lift = 0.70, .pitch = 0.4, .toe_out = -1.0},
                .retract = {.out = 0.02, .forward = 0.34, .lift = 0.38, .pitch = 0.5, .toe_out = -0.7},
                .body = {.y = -0.02, .heading = 0.95, .lean = -0.12, .tilt = -0.30},
                .spine = {.twist = -0.35},
                .left = {-0.02, 0.0, 0.25, 0.0},
                .right = {0.25, -0.40, -0.15, 0.1},
                .stand_toe_out = 1.0});
}

RawMotion kneeStrike(Studio& studio) {
  return kicks(studio, boxingGuard(),
               {.chamber = {.out = 0.10, .forward = 0.05, .lift = 0.25, .pitch = 0.5, .toe_out = 0.1},
                .hit = {.out = 0.05, .forward = 0.18, .lift = 0.52, .pitch = 0.7, .toe_out = 0.1},
                .retract = {.out = 0.10, .forward = 0.05, .lift = 0.20, .pitch = 0.5, .toe_out = 0.1},
                .body = {.y = 0.0, .lean = -0.12},
                .spine = {.bend = 0.25, .twist = 0.1},
                .left = {0.02, -0.20, 0.22, 0.0},
                .right = {0.02, -0.20, 0.20, 0.0}});
}

// Both hands on one grip before the body; cuts from either shoulder, thrusts and parries.
RawMotion sword(Studio& studio) {
  KeyPose base = standing(0.16);
  base.left_foot.forward = 0.20;
  base.right_foot.forward = -0.18;
  base.right_foot.toe_out = 0.5;
  base.pelvis.y = -0.07;
  base.right = {-0.12, -0.28, 0.32, 0.1};
  base.left = {-0.16, -0.34, 0.24, 0.1};
  KeySequence s(base);
  s.at(0.0);
  for (int i = 0; i < 5; ++i) {
    const double from = studio.chance(0.5) ? 1.0 : -1.0;
    KeyPose& raise = s.base(studio.uniform(0.35, 0.5));
    raise.right = {from > 0 ? 0.06 : -0.26, studio.uniform(0.10, 0.35), 0.18, 0.4};
    raise.left = {from > 0 ? -0.26 : 0.02, studio.uniform(0.08, 0.30), 0.20, 0.4};
    raise.spine.twist = -0.4 * from;
    raise.pelvis.heading = -0.15 * from;
    KeyPose& cut = s.base(studio.uniform(0.24, 0.32));
    const double depth = studio.uniform(-0.40, -0.05);
    cut.right = {from > 0 ? -0.22 : 0.08, depth, 0.42, 0.0};
    cut.left = {from > 0 ? -0.02 : -0.26, depth - 0.04, 0.34, 0.0};
    cut.spine = {.bend = 0.25, .twist = 0.4 * from};
    cut.pelvis.y = -0.12;
    s.then(0.12);
    s.base(studio.uniform(0.3, 0.5));
  }
  return {studio.play(s)};
}

constexpr std::array kRecipes = {
    Recipe{"box_jab", 2, &boxJab},
    Recipe{"box_cross", 2, &boxCross},
    Recipe{"box_hook", 2, &boxHook},
    Recipe{"box_uppercut", 2, &boxUppercut},
    Recipe{"box_shadow", 3, &shadowBox},
    Recipe{"punch_forward", 2, &punchForward},
    Recipe{"punch_side", 2, &punchSideways},
    Recipe{"block", 2, &block},
    Recipe{"kick_forward", 3, &kickForward},
    Recipe{"kick_side", 3, &kickSide},
    Recipe{"kick_roundhouse", 3, &kickRoundhouse},
    Recipe{"knee_strike", 2, &kneeStrike},
    Recipe{"sword", 2, &sword},
};

}  // namespace

std::span<const Recipe> fightingRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

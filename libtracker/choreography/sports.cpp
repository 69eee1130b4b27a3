#include <array>

#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Swings, throws and other sport.

namespace depthmocap {
namespace {

KeyPose wideReady(double half_width, double crouch) {
  KeyPose key = standing(half_width);
  key.pelvis.y = -crouch;
  key.spine.bend = 0.12;
  setHands(key, {-0.02, -0.28, 0.28, 0.0});
  return key;
}

// A swing in three keys - back, hit, through - from a ready stance, a few times.
struct Swing {
  KeyPose ready, back, hit, through;
  double back_s = 0.55, hit_s = 0.24, through_s = 0.26;
};

RawMotion swings(Studio& studio, const Swing& swing, int count = 2) {
  KeySequence s(swing.ready);
  s.at(0.0);
  s.then(0.2);
  for (int i = 0; i < count; ++i) {
    s.add(swing.back, studio.near(swing.back_s));
    s.then(0.08);
    s.add(swing.hit, studio.near(swing.hit_s, 0.08));
    s.add(swing.through, studio.near(swing.through_s, 0.08));
    s.then(0.12);
    s.base(studio.uniform(0.5, 0.8));
    s.base(studio.uniform(0.1, 0.4));
  }
  return {studio.play(s)};
}

RawMotion tennisForehand(Studio& studio) {
  Swing w;
  w.ready = wideReady(0.20, 0.10);
  w.back = w.hit = w.through = w.ready;
  w.back.pelvis.heading = -0.6;
  w.back.spine.twist = -0.45;
  w.back.head.turn = 0.7;
  w.back.right = {0.42, -0.12, -0.18, 0.2};
  w.back.left = {0.0, -0.10, 0.42, 0.1};
  w.hit.right = {0.30, -0.10, 0.42, 0.1};
  w.hit.left = {0.15, -0.15, 0.20, 0.1};
  w.hit.spine.twist = 0.05;
  w.hit.pelvis.heading = 0.05;
  w.through.right = {-0.26, 0.16, 0.26, 0.6};
  w.through.left = {0.18, -0.20, 0.10, 0.1};
  w.through.spine.twist = 0.55;
  w.through.pelvis.heading = 0.45;
  w.through.head.turn = -0.5;
  w.through.right_foot.pitch = 0.6;
  return swings(studio, w);
}

RawMotion tennisBackhand(Studio& studio) {
  Swing w;
  w.ready = wideReady(0.20, 0.10);
  w.back = w.hit = w.through = w.ready;
  w.back.pelvis.heading = 0.6;
  w.back.spine.twist = 0.5;
  w.back.head.turn = -0.8;
  w.back.right = {-0.28, -0.18, 0.20, 0.3};
  w.back.left = {0.05, -0.22, 0.12, 0.3};
  w.hit.right = {0.08, -0.12, 0.50, 0.1};
  w.hit.left = {0.20, -0.30, 0.05, 0.1};
  w.through.right = {0.42, 0.28, 0.12, 0.1};
  w.through.left = {0.30, -0.25, -0.22, 0.1};
  w.through.pelvis.heading = -0.25;
  w.through.spine.twist = -0.35;
  return swings(studio, w);
}

// Toss with the left, racket behind the back, hit above the head.
RawMotion tennisServe(Studio& studio) {
  Swing w;
  w.ready = standing(0.16);
  w.ready.left_foot.forward = 0.16;
  w.ready.right_foot.forward = -0.14;
  w.ready.right_foot.toe_out = 0.6;
  w.ready.pelvis.heading = -0.5;
  setHands(w.ready, {-0.06, -0.24, 0.30, 0.0});
  w.back = w.hit = w.through = w.ready;
  w.back.left = {0.02, 0.52, 0.22, 0.0};
  w.back.right = {0.18, 0.22, -0.10, 0.1};
  w.back.pelvis.y = -0.10;
  w.back.spine = {.bend = -0.22, .twist = -0.35, .side = 0.15};
  w.back.head = {.nod = -0.45, .turn = 0.5};
  w.hit.right = {0.04, 0.58, 0.14, 0.0};
  w.hit.left = {0.0, -0.10, 0.28, 0.0};
  w.hit.pelvis.heading = 0.0;
  w.hit.spine = {.bend = 0.0, .twist = 0.2, .side = -0.15};
  w.hit.left_foot.pitch = w.hit.right_foot.pitch = 0.5;
  w.hit.pelvis.y = 0.04;
  w.through.right = {-0.22, -0.35, 0.28, 0.1};
  w.through.left = {-0.05, -0.30, 0.15, 0.1};
  w.through.pelvis.heading = 0.35;
  w.through.pelvis.lean = 0.3;
  w.through.spine = {.bend = 0.4, .twist = 0.35};
  w.through.right_foot.pitch = 0.8;
  w.back_s = 0.8;
  return swings(studio, w);
}

RawMotion golf(Studio& studio) {
  Swing w;
  w.ready = standing(0.20);
  w.ready.pelvis.y = -0.07;
  w.ready.pelvis.lean = 0.32;
  w.ready.spine.bend = 0.28;
  w.ready.head.nod = 0.25;
  w.ready.right = {-0.15, -0.44, 0.24, 0.0};
  w.ready.left = {-0.16, -0.41, 0.26, 0.0};
  w.back = w.hit = w.through = w.ready;
  w.back.pelvis.heading = -0.5;
  w.back.spine.twist = -0.75;
  w.back.head.turn = 0.9;
  w.back.right = {0.10, 0.22, 0.22, 0.1};
  w.back.left = {-0.30, 0.16, 0.30, 0.2};
  w.back.left_foot.pitch = 0.2;
  w.hit.pelvis.heading = 0.3;
  w.through.pelvis.heading = 0.9;
  w.through.pelvis.lean = 0.05;
  w.through.pelvis.y = -0.02;
  w.through.spine = {.bend = 0.0, .twist = 0.7};
  w.through.head = {.turn = 0.2};
  w.through.left = {0.08, 0.26, 0.18, 0.1};
  w.through.right = {-0.28, 0.20, 0.26, 0.3};
  w.through.right_foot.pitch = 0.9;
  w.back_s = 0.8;
  w.hit_s = 0.26;
  w.through_s = 0.32;
  return swings(studio, w);
}

RawMotion throwHigh(Studio& studio) {
  Swing w;
  w.ready = standing(0.16);
  w.ready.left_foot.forward = 0.15;
  w.ready.right_foot.forward = -0.15;
  w.back = w.hit = w.through = w.ready;
  w.back.pelvis.heading = -0.6;
  w.back.spine = {.bend = -0.12, .twist = -0.45};
  w.back.head.turn = 0.8;
  w.back.right = {0.30, 0.22, -0.16, 0.0};
  w.back.left = {0.05, 0.05, 0.48, 0.1};
  w.hit.right = {0.05, 0.42, 0.34, 0.0};
  w.hit.left = {0.10, -0.25, 0.15, 0.1};
  w.hit.spine.twist = 0.3;
  w.hit.pelvis.z = 0.06;
  w.through.right = {-0.22, -0.30, 0.34, 0.0};
  w.through.left = {0.15, -0.40, -0.10, 0.1};
  w.through.pelvis.heading = 0.35;
  w.through.pelvis.lean = 0.25;
  w.through.spine = {.bend = 0.35, .twist = 0.4};
  w.through.right_foot.pitch = 0.7;
  if (studio.variant % 3 == 2) w.through.right = {-0.05, 0.10, 0.50, 0.0};
  return swings(studio, w);
}

RawMotion bowl(Studio& studio) {
  Swing w;
  w.ready = standing(0.12);
  w.ready.right = {-0.02, -0.22, 0.28, 0.0};
  w.back = w.hit = w.through = w.ready;
  w.back.right = {0.16, -0.34, -0.34, 0.0};
  w.back.left = {0.40, -0.20, 0.15, 0.1};
  w.back.pelvis.y = -0.12;
  w.back.pelvis.lean = 0.25;
  w.back.left_foot.forward = 0.30;
  w.hit.left_foot.forward = w.through.left_foot.forward = 0.30;
  w.hit.pelvis.y = -0.24;
  w.hit.pelvis.lean = 0.4;
  w.hit.spine.bend = 0.3;
  w.hit.right = {0.02, -0.52, 0.14, 0.0};
  w.hit.left = {0.42, -0.15, 0.0, 0.1};
  w.through.pelvis.y = -0.20;
  w.through.pelvis.lean = 0.3;
  w.through.right = {-0.08, 0.12, 0.48, 0.0};
  w.through.left = {0.42, -0.15, 0.0, 0.1};
  w.hit_s = 0.32;
  return swings(studio, w);
}

RawMotion batSwing(Studio& studio) {
  Swing w;
  w.ready = wideReady(0.22, 0.10);
  w.ready.pelvis.heading = -0.9;
  w.ready.head.turn = 1.0;
  w.ready.right = {0.10, 0.05, 0.22, 0.4};
  w.ready.left = {-0.28, 0.0, 0.22, 0.4};
  w.back = w.hit = w.through = w.ready;
  w.back.spine.twist = -0.4;
  w.back.left_foot.lift = 0.08;
  w.hit.pelvis.heading = -0.1;
  w.hit.spine.twist = 0.1;
  w.hit.head.turn = 0.2;
  w.hit.right = {-0.12, -0.20, 0.40, 0.1};
  w.hit.left = {-0.10, -0.22, 0.42, 0.1};
  w.through.pelvis.heading = 0.4;
  w.through.spine.twist = 0.5;
  w.through.head.turn = -0.4;
  w.through.right = {-0.26, 0.12, 0.24, 0.4};
  w.through.left = {0.12, 0.10, 0.18, 0.2};
  w.through.right_foot.pitch = 0.8;
  return swings(studio, w);
}

RawMotion basketballShot(Studio& studio) {
  KeySequence s(wideReady(0.15, 0.04));
  s.at(0.0);
  for (int i = 0; i < 3; ++i) {
    KeyPose& dip = s.base(0.4);
    dip.pelvis.y = -0.18;
    dip.spine.bend = 0.2;
    dip.right = {-0.12, -0.20, 0.26, 0.0};
    dip.left = {-0.12, -0.18, 0.26, 0.0};
    KeyPose& lift = s.base(0.32);
    lift.right = {-0.08, 0.26, 0.18, 0.1};
    lift.left = {-0.10, 0.26, 0.20, 0.2};
    KeyPose& shot = s.base(0.26);
    shot.right = {-0.05, 0.52, 0.30, 0.0};
    shot.left = {-0.02, 0.36, 0.24, 0.1};
    shot.pelvis.y = 0.04;
    shot.left_foot.pitch = shot.right_foot.pitch = 0.6;
    shot.head.nod = -0.2;
    s.then(0.3);
    s.base(0.6);
  }
  return {studio.play(s)};
}

RawMotion dribble(Studio& studio) {
  KeyPose base = wideReady(0.18, 0.16);
  base.pelvis.lean = 0.2;
  base.right = {0.16, -0.20, 0.30, 0.1};
  KeySequence s(base);
  s.at(0.0);
  for (int i = 0; i < 8; ++i) {
    KeyPose& down = s.base(studio.uniform(0.18, 0.25));
    down.right = {0.14, -0.42, 0.26, 0.1};
    down.pelvis.x = studio.uniform(-0.05, 0.05);
    down.spine.twist = studio.uniform(-0.2, 0.2);
    s.base(studio.uniform(0.2, 0.28));
  }
  return {studio.play(s)};
}

// Arms of the crawl, the body bent forward.
RawMotion swimCrawl(Studio& studio) {
  KeyPose base = standing(0.16);
  base.pelvis.lean = studio.variant == 0 ? 0.5 : 0.15;
  base.pelvis.y = -0.06;
  base.head.nod = -0.3;
  static constexpr std::array<HandTarget, 4> kCrawl = {
      {{-0.02, 0.30, 0.46, 0.1}, {-0.04, -0.30, 0.30, 0.2}, {0.14, -0.46, -0.14, 0.1}, {0.34, 0.10, -0.05, 0.4}}};
  KeySequence s(base);
  for (std::size_t i = 0; i < 14; ++i) {
    KeyPose& key = i == 0 ? s.at(0.0) : s.base(studio.uniform(0.30, 0.36));
    key.right = kCrawl[i % 4];
    key.left = kCrawl[(i + 2) % 4];
    key.spine.twist = i % 4 < 2 ? 0.25 : -0.25;
  }
  return {studio.play(s, 0.02)};
}

// Lifting weights: curls, presses over the head, raises to the side and front.
RawMotion lift(Studio& studio) {
  static constexpr std::array<std::array<HandTarget, 2>, 5> kLifts = {
      {{{{0.06, -0.50, 0.10, 0.0}, {0.02, -0.06, 0.20, -0.1}}},
       {{{0.08, 0.08, 0.14, 0.1}, {0.0, 0.60, 0.05, 0.0}}},
       {{{0.08, -0.52, 0.05, 0.0}, {0.52, 0.05, 0.06, 0.0}}},
       {{{0.04, -0.52, 0.08, 0.0}, {-0.02, 0.0, 0.55, 0.1}}},
       {{{-0.04, -0.50, 0.14, 0.0}, {-0.06, -0.08, 0.14, 0.9}}}}};
  KeySequence s(standing(0.15));
  s.at(0.0);
  const auto& kind = kLifts[static_cast<std::size_t>(studio.variant) % kLifts.size()];
  const bool alternate = studio.chance(0.3);
  for (int i = 0; i < 2; ++i) {
    setHands(s.base(0.55), kind[0]);
    KeyPose& up = s.then(studio.uniform(0.6, 0.9));
    if (!alternate || i % 2 == 0) up.left = kind[1];
    if (!alternate || i % 2 == 1) up.right = kind[1];
    up.spine.bend = -0.06;
    s.then(0.15);
  }
  s.base(0.7);
  return {studio.play(s, 0.015)};
}

RawMotion pullRope(Studio& studio) {
  KeyPose base = standing(0.18);
  base.left_foot.forward = 0.22;
  base.right_foot.forward = -0.18;
  base.pelvis.y = -0.12;
  KeySequence s(base);
  s.at(0.0);
  for (int i = 0; i < 8; ++i) {
    KeyPose& key = s.base(studio.uniform(0.4, 0.55));
    const HandTarget far{-0.12, -0.08, 0.46, 0.0};
    const HandTarget close{-0.02, -0.24, 0.10, 0.1};
    key.right = i % 2 == 0 ? far : close;
    key.left = i % 2 == 0 ? close : far;
    key.spine.twist = i % 2 == 0 ? 0.25 : -0.25;
    key.pelvis.lean = i % 2 == 0 ? 0.1 : -0.05;
  }
  return {studio.play(s)};
}

constexpr std::array kRecipes = {
    Recipe{"tennis_forehand", 2, &tennisForehand},
    Recipe{"tennis_backhand", 2, &tennisBackhand},
    Recipe{"tennis_serve", 2, &tennisServe},
    Recipe{"golf_swing", 3, &golf},
    Recipe{"throw_high", 3, &throwHigh},
    Recipe{"bowl", 2, &bowl},
    Recipe{"bat_swing", 2, &batSwing},
    Recipe{"basketball_shot", 2, &basketballShot},
    Recipe{"dribble", 2, &dribble},
    Recipe{"swim_crawl", 2, &swimCrawl},
    Recipe{"lift_weights", 5, &lift},
    Recipe{"pull_rope", 2, &pullRope},
};

}  // namespace

std::span<const Recipe> sportsRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

#include <array>
#include <cmath>

#include "libtracker/choreography/easing.h"
#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Waving, pointing, clapping and what hands say.

namespace depthmocap {
namespace {

// The right hand goes to and fro between two places; the left does the same (mirrored) if `both`.
RawMotion toAndFro(Studio& studio, const HandTarget& a, const HandTarget& b, double half_s, bool both, int count = 3) {
  KeySequence s(standing(studio.uniform(0.08, 0.16)));
  s.at(0.0);
  s.then(0.25);
  double wait = studio.uniform(0.5, 0.7);
  for (int i = 0; i < count; ++i) {
    for (const HandTarget& place : {a, b}) {
      KeyPose& key = s.base(wait);
      key.right = place;
      if (both) key.left = place;
      key.spine.side = both ? 0.0 : studio.uniform(0.0, 0.05);
      wait = studio.near(half_s, 0.12);
    }
  }
  s.base(0.6);
  s.then(0.2);
  return {studio.play(s, 0.02)};
}

RawMotion waveHigh(Studio& studio) {
  const double up = studio.uniform(0.25, 0.45);
  const HandTarget in{studio.uniform(-0.08, 0.02), up, 0.20, 0.3};
  const HandTarget out{studio.uniform(0.22, 0.36), up - 0.03, 0.16, 0.1};
  return toAndFro(studio, in, out, studio.uniform(0.25, 0.45), studio.variant == 3);
}
RawMotion waveTwoHands(Studio& studio) {
  const double up = studio.uniform(0.30, 0.48);
  return toAndFro(studio, {-0.06, up, 0.12, 0.2}, {0.32, up - 0.06, 0.08, 0.1}, studio.uniform(0.3, 0.5), true);
}
// The forearm alone waves beside the body.
RawMotion waveLow(Studio& studio) {
  const double up = studio.uniform(-0.10, 0.10);
  return toAndFro(studio, {-0.02, up, 0.24, 0.0}, {0.26, up, 0.18, -0.2}, studio.uniform(0.22, 0.35),
                  studio.variant == 2);
}
// The stretched arm sweeps at the height of the shoulder.
RawMotion waveHorizontal(Studio& studio) {
  const double up = studio.uniform(-0.12, 0.08);
  return toAndFro(studio, {0.50, up, 0.10, 0.1}, {-0.22, up, 0.42, 0.2}, studio.uniform(0.5, 0.75), studio.variant == 3,
                  4);
}
// Big arcs from the side over the head.
RawMotion waveBig(Studio& studio) {
  return toAndFro(studio, {0.42, 0.25, 0.08, 0.0}, {-0.15, 0.55, 0.12, 0.0}, studio.uniform(0.45, 0.6),
                  studio.variant % 2 == 1, 4);
}
RawMotion clap(Studio& studio) {
  const double up = studio.variant == 2 ? 0.20 : studio.uniform(-0.25, -0.05);
  return toAndFro(studio, {0.05, up, 0.30, 0.1}, {-0.165, up, 0.34, 0.1}, studio.uniform(0.18, 0.28), true, 8);
}
RawMotion clapOverhead(Studio& studio) {
  return toAndFro(studio, {0.46, 0.15, 0.05, 0.0}, {-0.15, 0.52, 0.08, 0.0}, studio.uniform(0.4, 0.55), true, 5);
}
RawMotion beckon(Studio& studio) {
  return toAndFro(studio, {0.02, -0.08, 0.50, 0.0}, {-0.02, 0.06, 0.22, 0.0}, studio.uniform(0.35, 0.5),
                  studio.variant == 1, 4);
}
RawMotion shooAway(Studio& studio) {
  return toAndFro(studio, {-0.15, -0.10, 0.22, 0.5}, {0.35, -0.15, 0.35, 0.1}, studio.uniform(0.3, 0.45), false, 5);
}
RawMotion flap(Studio& studio) {
  return toAndFro(studio, {0.46, 0.25, 0.0, 0.0}, {0.40, -0.32, 0.05, 0.0}, studio.uniform(0.35, 0.55), true, 5);
}
RawMotion punchTheAir(Studio& studio) {
  return toAndFro(studio, {0.10, 0.05, 0.15, 0.0}, {0.02, 0.56, 0.12, 0.0}, studio.uniform(0.3, 0.4),
                  studio.variant % 2 == 1, 5);
}

// A hand (or both) goes to a place, stays and comes back.
struct Touch {
  HandTarget right;
  HandTarget left = kAtSide;
  HeadState head{};
  SpineState spine{};
};

RawMotion touches(Studio& studio, std::span<const Touch> list) {
  KeySequence s(standing(studio.uniform(0.08, 0.15)));
  s.at(0.0);
  for (const Touch& touch : list) {
    KeyPose& key = s.base(studio.uniform(0.55, 0.85));
    key.right = touch.right;
    key.left = touch.left;
    key.head = touch.head;
    key.spine = touch.spine;
    s.then(studio.uniform(0.4, 0.9));
    if (studio.chance(0.6)) s.base(studio.uniform(0.5, 0.8));
  }
  s.base(0.7);
  return {studio.play(s, 0.02)};
}

RawMotion handsAtHead(Studio& studio) {
  static constexpr std::array kTouches = {
      Touch{{-0.05, 0.22, 0.07, 0.2}, kAtSide, {.side = 0.1}},                  // phone at the ear
      Touch{{-0.12, 0.30, 0.10, 0.5}, kAtSide, {.nod = -0.1}},                  // salute
      Touch{{-0.14, 0.10, 0.16, 0.1}, kAtSide, {.nod = 0.2}},                   // chin
      Touch{{-0.13, 0.30, 0.04, 0.3}, {-0.13, 0.30, 0.04, 0.3}, {.nod = 0.3}},  // both hands on the head
      Touch{{-0.15, 0.20, 0.15, 0.2}, {-0.15, 0.20, 0.15, 0.2}, {.nod = 0.4}},  // hands before the face
      Touch{{-0.16, 0.32, 0.14, 0.9}, kAtSide, {.nod = -0.15, .turn = 0.3}},    // shading the eyes
  };
  return touches(studio, kTouches);
}

RawMotion drinkAndWatch(Studio& studio) {
  static constexpr std::array kTouches = {
      Touch{{-0.15, 0.14, 0.18, 0.3}, kAtSide, {.nod = -0.3}, {.bend = -0.08}},    // drink
      Touch{kAtSide, {-0.12, -0.12, 0.26, 0.6}, {.nod = 0.4, .turn = 0.1}},        // look at the watch
      Touch{{-0.10, -0.05, 0.30, 0.0}, {-0.12, -0.22, 0.26, 0.0}, {.nod = 0.35}},  // write on the palm
      Touch{{0.02, -0.45, 0.16, 0.2}, kOnHip, {}},                                 // hand in the pocket
      Touch{{-0.24, 0.02, 0.14, 0.2}, kAtSide, {.turn = 0.4}, {.twist = 0.1}},     // on the other shoulder
  };
  return touches(studio, kTouches);
}

RawMotion greetings(Studio& studio) {
  static constexpr std::array kTouches = {
      Touch{{-0.165, -0.08, 0.24, 0.2}, {-0.165, -0.08, 0.24, 0.2}, {.nod = 0.3}, {.bend = 0.2}},  // palms together
      Touch{{-0.10, -0.16, 0.42, 0.0}, kAtSide, {.nod = 0.05}, {.bend = 0.1}},                     // offer the hand
      Touch{{-0.18, -0.12, 0.14, 0.2}, {0.08, -0.5, 0.0, 0.0}, {.nod = 0.4}, {.bend = 0.5}},       // bow
      Touch{{0.30, -0.20, 0.32, 0.0}, {0.30, -0.20, 0.32, 0.0}, {.nod = -0.1}, {.bend = -0.05}},   // open arms
      Touch{{0.22, -0.28, 0.20, -0.3}, {0.22, -0.28, 0.20, -0.3}, {.nod = -0.1, .side = 0.15}},    // shrug
      Touch{{-0.05, -0.02, 0.48, 0.1}, {-0.05, -0.02, 0.48, 0.1}, {}, {.bend = 0.1}},              // stop!
  };
  return touches(studio, kTouches);
}

// Talking: both hands move before the body, hardly the same twice.
RawMotion talk(Studio& studio) {
  KeySequence s(standing(studio.uniform(0.08, 0.15)));
  s.at(0.0);
  const auto place = [&](HandTarget& hand) {
    if (studio.chance(0.25)) return;
    hand = {studio.uniform(-0.12, 0.30), studio.uniform(-0.38, 0.12), studio.uniform(0.18, 0.42),
            studio.uniform(-0.2, 0.3)};
  };
  for (int i = 0; i < 9; ++i) {
    KeyPose& key = s.base(studio.uniform(0.35, 0.8));
    place(key.left);
    place(key.right);
    key.spine.twist = studio.uniform(-0.2, 0.2);
    key.head = {studio.uniform(-0.15, 0.25), studio.uniform(-0.12, 0.12), studio.uniform(-0.45, 0.45)};
  }
  return {studio.play(s)};
}

// Pointing or reaching to every direction, eyes and trunk follow.
RawMotion point(Studio& studio) {
  KeySequence s(standing(studio.uniform(0.1, 0.2)));
  s.at(0.0);
  for (int i = 0; i < 5; ++i) {
    const double yaw = studio.uniform(degrees(-120), degrees(60));  // < 0 to the right, the arm's own side
    const double pitch = studio.uniform(degrees(-55), degrees(70));
    const double level = 0.56 * std::cos(pitch);
    KeyPose& key = s.base(studio.uniform(0.55, 0.8));
    key.right = {-level * std::sin(yaw), 0.56 * std::sin(pitch), level * std::cos(yaw), 0.0};
    const double turn = yaw < 0 ? 0.35 * yaw : 0.5 * yaw;
    key.spine.twist = 0.5 * turn;
    key.pelvis.heading = 0.3 * turn;
    key.head = {-0.4 * pitch, 0.0, turn};
    s.then(studio.uniform(0.25, 0.6));
    if (studio.chance(0.4)) s.base(0.6);
  }
  s.base(0.7);
  return {studio.play(s, 0.02)};
}

// The whole sphere around both shoulders, one place after the other.
RawMotion reachAround(Studio& studio) {
  KeySequence s(standing(studio.uniform(0.1, 0.22)));
  s.at(0.0);
  const bool together = studio.variant % 3 == 2;
  for (int i = 0; i < 10; ++i) {
    KeyPose& key = s.base(studio.uniform(0.65, 0.95));
    key.right = randomReach(studio.random);
    key.left = together ? key.right : randomReach(studio.random);
    key.spine = {studio.uniform(-0.1, 0.2), studio.uniform(-0.3, 0.3), studio.uniform(-0.15, 0.15)};
    key.head = {studio.uniform(-0.3, 0.3), studio.uniform(-0.15, 0.15), studio.uniform(-0.6, 0.6)};
    key.pelvis.heading = studio.uniform(-0.25, 0.25);
  }
  s.base(0.9);
  return {studio.play(s, 0.0)};
}

// Catching things that come from anywhere.
RawMotion handCatch(Studio& studio) {
  KeyPose ready = standing(0.18);
  ready.pelvis.y = -0.08;
  ready.spine.bend = 0.15;
  setHands(ready, {0.02, -0.22, 0.28, 0.0});
  KeySequence s(ready);
  s.at(0.0);
  for (int i = 0; i < 5; ++i) {
    KeyPose& key = s.base(studio.uniform(0.3, 0.45));
    const double side = studio.uniform(-0.15, 0.40);
    const double up = studio.uniform(-0.35, 0.50);
    key.right = {side, up, 0.25, 0.0};
    if (studio.variant % 2 == 1) key.left = {-side - 0.25, up, 0.28, 0.0};
    key.spine.twist = -0.5 * side;
    key.spine.side = 0.4 * side;
    key.pelvis.y = up < -0.2 ? -0.2 : -0.05;
    s.then(0.15);
    KeyPose& hold = s.base(0.4);
    hold.right = kBeforeChest;
    s.base(0.5);
  }
  return {studio.play(s)};
}

constexpr std::array kRecipes = {
    Recipe{"wave_high", 4, &waveHigh},
    Recipe{"wave_two_hands", 2, &waveTwoHands},
    Recipe{"wave_low", 3, &waveLow},
    Recipe{"wave_horizontal", 3, &waveHorizontal},
    Recipe{"wave_big", 2, &waveBig},
    Recipe{"clap", 3, &clap},
    Recipe{"clap_overhead", 2, &clapOverhead},
    Recipe{"beckon", 2, &beckon},
    Recipe{"shoo_away", 2, &shooAway},
    Recipe{"flap", 2, &flap},
    Recipe{"punch_the_air", 2, &punchTheAir},
    Recipe{"hands_at_head", 2, &handsAtHead},
    Recipe{"drink_and_watch", 2, &drinkAndWatch},
    Recipe{"greetings", 2, &greetings},
    Recipe{"talk", 2, &talk},
    Recipe{"point", 3, &point},
    Recipe{"reach_around", 7, &reachAround},
    Recipe{"catch", 2, &handCatch},
};

}  // namespace

std::span<const Recipe> gestureRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

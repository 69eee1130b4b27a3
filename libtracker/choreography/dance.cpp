#include <array>
#include <cmath>

#include "libtracker/choreography/easing.h"
#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Dancing: steps on a beat below, arms all over above.

namespace depthmocap {
namespace {

// Steps of one beat each; the feet come back to the middle every second beat.
void danceStep(Studio& studio, int beat, KeyPose& key) {
  const bool left = (beat / 2) % 2 == 0;
  FootKey& foot = left ? key.left_foot : key.right_foot;
  if (beat % 2 == 0) {
    switch (studio.random.below(5)) {
      case 0:
        foot.out += studio.uniform(0.15, 0.32);
        key.pelvis.x = (left ? 0.09 : -0.09);
        break;
      case 1:
        foot.forward += studio.uniform(0.15, 0.30);
        break;
      case 2:
        foot.forward -= studio.uniform(0.15, 0.28);
        break;
      case 3:
        foot = {.out = 0.09, .forward = 0.10, .lift = studio.uniform(0.12, 0.4), .pitch = 0.5};
        break;
      default:
        foot.out = -0.06;
        foot.forward += 0.20;
        break;
    }
    key.pelvis.y = -studio.uniform(0.02, 0.10);
  }
  key.pelvis.tilt = studio.uniform(-0.12, 0.12);
  key.pelvis.heading = studio.uniform(-0.4, 0.4);
  key.spine = {studio.uniform(-0.12, 0.18), -0.7 * key.pelvis.heading + studio.uniform(-0.25, 0.25),
               -1.3 * key.pelvis.tilt};
  key.head = {studio.uniform(-0.2, 0.2), studio.uniform(-0.15, 0.15), studio.uniform(-0.5, 0.5)};
}

// Random arms on random steps.
RawMotion freestyle(Studio& studio) {
  KeyPose base = standing(0.11);
  base.pelvis.y = -0.04;
  KeySequence s(base);
  s.at(0.0);
  const double beat_s = studio.uniform(0.48, 0.62);
  for (int beat = 0; beat < 10; ++beat) {
    KeyPose& key = s.base(beat_s);
    danceStep(studio, beat, key);
    const bool hold = beat % 2 == 1 && studio.chance(0.5);
    const auto& before = s.keys()[s.keys().size() - 2];
    key.right = hold ? before.right : randomReach(studio.random);
    key.left = studio.chance(0.3) ? key.right : randomReach(studio.random);
  }
  s.base(0.8);
  return {studio.play(s, 0.015)};
}

// Step and touch from side to side, arms swing along, up or round.
RawMotion sideTouch(Studio& studio) {
  KeyPose base = standing(0.12);
  base.pelvis.y = -0.05;
  KeySequence s(base);
  s.at(0.0);
  const double beat_s = studio.uniform(0.42, 0.55);
  const double height = studio.uniform(-0.35, 0.45);
  for (int i = 0; i < 10; ++i) {
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    KeyPose& key = s.base(beat_s);
    key.left_foot.out = key.right_foot.out = 0.20;
    FootKey& free = side > 0 ? key.right_foot : key.left_foot;
    free.pitch = 0.5;
    free.out = 0.14;
    key.pelvis.x = 0.10 * side;
    key.pelvis.held = 0.5;
    key.pelvis.tilt = 0.10 * side;
    key.pelvis.heading = 0.25 * side;
    key.spine = {0.05, 0.2 * side, -0.12 * side};
    key.right = {side > 0 ? -0.20 : 0.36, height, 0.28, 0.2};
    key.left = {side > 0 ? 0.36 : -0.20, height, 0.28, 0.2};
  }
  return {studio.play(s, 0.03)};
}

// Small steps to and fro, swinging hips, hands before the waist.
RawMotion salsa(Studio& studio) {
  KeyPose base = standing(0.08);
  base.pelvis.y = -0.05;
  setHands(base, {0.06, -0.22, 0.24, 0.1});
  KeySequence s(base);
  s.at(0.0);
  const double beat_s = studio.uniform(0.38, 0.46);
  for (int i = 0; i < 14; ++i) {
    KeyPose& key = s.base(beat_s);
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    const int phase = i % 8;
    if (phase == 1) key.left_foot.forward = 0.22;
    if (phase == 5) key.right_foot.forward = -0.22;
    key.pelvis.tilt = 0.13 * side;
    key.pelvis.heading = 0.15 * side;
    key.spine = {0.03, -0.25 * side, -0.16 * side};
    key.right.forward += 0.08 * side;
    key.left.forward -= 0.08 * side;
    key.right.up += studio.uniform(-0.06, 0.10);
    key.left.up += studio.uniform(-0.06, 0.10);
    if (i > 8 && i < 13) key.right = {0.02, 0.46, 0.14, 0.2};
  }
  return {studio.play(s, 0.02)};
}

// The classical arm positions, slowly joined, with extended legs.
RawMotion ballet(Studio& studio) {
  static constexpr std::array<HandTarget, 5> kPositions = {{{-0.08, -0.44, 0.20, 0.5},
                                                            {-0.06, -0.10, 0.38, 0.6},
                                                            {0.48, -0.02, 0.14, 0.3},
                                                            {-0.06, 0.52, 0.16, 0.3},
                                                            {0.34, 0.34, 0.18, 0.2}}};
  KeyPose base = standing(0.09);
  base.left_foot.toe_out = base.right_foot.toe_out = 0.7;
  setHands(base, kPositions[0]);
  KeySequence s(base);
  s.at(0.0);
  for (int i = 0; i < 6; ++i) {
    KeyPose& key = s.base(studio.uniform(0.8, 1.1));
    key.left = kPositions[studio.random.below(kPositions.size())];
    key.right = kPositions[studio.random.below(kPositions.size())];
    key.spine.side = studio.uniform(-0.2, 0.2);
    key.head = {studio.uniform(-0.2, 0.1), 0.0, studio.uniform(-0.5, 0.5)};
    switch (studio.random.below(4)) {
      case 0:
        key.pelvis.y = -studio.uniform(0.12, 0.28);  // plie
        break;
      case 1:
        key.left_foot.pitch = key.right_foot.pitch = 0.8;  // releve
        key.pelvis.y = 0.06;
        break;
      case 2:
        key.right_foot = {
            .out = 0.10, .forward = -0.42, .lift = studio.uniform(0.1, 0.4), .pitch = 1.1, .toe_out = 0.5};
        key.pelvis.lean = 0.15;
        break;
      default:
        key.right_foot = {
            .out = 0.50, .forward = 0.05, .lift = studio.uniform(0.02, 0.3), .pitch = 0.7, .toe_out = 0.6};
        break;
    }
  }
  s.base(1.0);
  return {studio.play(s, 0.015)};
}

// Walking a figure on the floor with waving arms.
RawMotion danceWalk(Studio& studio) {
  const double radius = studio.uniform(0.4, 0.7);
  const double lap_s = studio.uniform(3.8, 4.6);
  const double turns = studio.chance(0.5) ? 1.0 : 0.0;  // faces along the circle, or stays facing the camera
  const auto path = [=](double t) {
    const double a = 2 * std::numbers::pi * t / lap_s;
    return PathPoint{radius * (1 - std::cos(a)), radius * std::sin(a), turns * a};
  };
  GaitStyle style;
  style.cycle_s = studio.uniform(0.9, 1.1);
  style.foot_roll = 0.5;
  style.clearance = 0.05;
  style.pelvis_list = 0.10;
  style.crouch = 0.03;
  BodyFrames frames = walkAlong(path, 6.5, style, studio.random.uniform());
  KeySequence s(standing());
  s.at(0.0);
  for (int i = 0; i < 11; ++i) {
    KeyPose& key = s.base(studio.uniform(0.6, 0.8));
    key.right = randomReach(studio.random);
    key.left = studio.chance(0.5) ? key.right : randomReach(studio.random);
    key.spine = {studio.uniform(-0.1, 0.15), studio.uniform(-0.25, 0.25), studio.uniform(-0.15, 0.15)};
  }
  overlayUpperBody(studio.play(s, 0.01), frames);
  return {frames};
}

constexpr std::array kRecipes = {
    Recipe{"dance_freestyle", 7, &freestyle}, Recipe{"dance_side_touch", 2, &sideTouch},
    Recipe{"dance_salsa", 2, &salsa},         Recipe{"dance_ballet", 3, &ballet},
    Recipe{"dance_walk", 3, &danceWalk},
};

}  // namespace

std::span<const Recipe> danceRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

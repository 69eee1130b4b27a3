#include <array>

#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Sitting and kneeling.

namespace depthmocap {
namespace {

constexpr HandTarget kOnThigh{0.0, -0.38, 0.26, 0.1};

// On a chair behind the feet.
KeyPose seated(Studio& studio) {
  KeyPose key = standing(studio.uniform(0.12, 0.2));
  key.pelvis.held = 1.0;
  key.pelvis.y = -studio.uniform(0.37, 0.44);
  key.pelvis.z = -0.36;
  key.pelvis.lean = -0.08;
  key.spine.bend = 0.12;
  key.left_foot.forward = studio.uniform(0.0, 0.15);
  key.right_foot.forward = studio.uniform(0.0, 0.15);
  setHands(key, kOnThigh);
  return key;
}

// On the way between standing and sitting: the trunk forward, the hips back.
KeyPose halfway(const KeyPose& seat) {
  KeyPose key = seat;
  key.pelvis.held = 0.7;
  key.pelvis.y = 0.55 * seat.pelvis.y;
  key.pelvis.z = 0.70 * seat.pelvis.z;
  key.pelvis.lean = 0.60;
  key.spine.bend = 0.30;
  key.head.nod = -0.25;
  setHands(key, {0.06, -0.42, 0.26, 0.1});
  return key;
}

KeyPose feetOf(KeyPose key, const KeyPose& seat) {
  key.left_foot = seat.left_foot;
  key.right_foot = seat.right_foot;
  return key;
}

RawMotion sitAndStand(Studio& studio) {
  const KeyPose seat = seated(studio);
  const KeyPose up = feetOf(standing(), seat);
  KeySequence s(seat);
  s.add(up, 0.01);
  for (int i = 0; i < 2; ++i) {
    s.add(up, 0.4);
    s.add(halfway(seat), studio.uniform(0.55, 0.75));
    s.base(studio.uniform(0.45, 0.6));
    s.then(studio.uniform(0.5, 1.0));
    s.add(halfway(seat), studio.uniform(0.5, 0.7));
    s.add(up, studio.uniform(0.55, 0.7));
  }
  s.then(0.3);
  return {studio.play(s, 0.02)};
}

RawMotion sitAndTalk(Studio& studio) {
  KeySequence s(seated(studio));
  s.at(0.0);
  const auto place = [&](HandTarget& hand) {
    if (studio.chance(0.35)) return;
    hand = {studio.uniform(-0.12, 0.32), studio.uniform(-0.25, 0.30), studio.uniform(0.22, 0.42),
            studio.uniform(-0.2, 0.3)};
  };
  for (int i = 0; i < 9; ++i) {
    KeyPose& key = s.base(studio.uniform(0.5, 0.9));
    place(key.left);
    place(key.right);
    key.pelvis.lean += studio.uniform(-0.1, 0.25);
    key.spine = {studio.uniform(-0.05, 0.3), studio.uniform(-0.3, 0.3), studio.uniform(-0.15, 0.15)};
    key.head = {studio.uniform(-0.2, 0.3), studio.uniform(-0.15, 0.15), studio.uniform(-0.6, 0.6)};
  }
  return {studio.play(s)};
}

// Raising a hand, waving, crossing and stretching a leg, reaching down to a shoe.
RawMotion sitAndMove(Studio& studio) {
  KeySequence s(seated(studio));
  s.at(0.0);
  KeyPose& raise = s.base(0.8);
  raise.right = {0.05, 0.55, 0.10, 0.0};
  s.then(0.5);
  KeyPose& leg = s.base(0.9);
  leg.left_foot.lift = studio.uniform(0.15, 0.4);
  leg.left_foot.forward = 0.45;
  leg.left_foot.pitch = -0.3;
  s.then(0.4);
  s.base(0.7);
  KeyPose& down = s.base(0.9);
  down.pelvis.lean = 0.7;
  down.spine.bend = 0.6;
  setHands(down, {-0.02, -0.20, 0.46, 0.0});
  s.then(0.4);
  KeyPose& stretch = s.base(1.0);
  setHands(stretch, {0.12, 0.55, 0.0, 0.0});
  stretch.spine.bend = -0.2;
  stretch.head.nod = -0.3;
  s.then(0.5);
  KeyPose& crossed = s.base(0.9);
  setHands(crossed, {-0.20, -0.20, 0.16, 0.3});
  s.then(0.6);
  s.base(0.8);
  return {studio.play(s)};
}

KeyPose kneelingRight(Studio& studio) {
  KeyPose key = standing(0.11);
  key.left_foot.forward = 0.26;
  key.right_foot = {.out = 0.11, .forward = -0.52, .pitch = 1.15, .toe_out = 0.0};
  key.pelvis.y = -0.435;
  key.pelvis.z = -0.08;
  key.pelvis.held = 0.8;
  key.pelvis.lean = studio.uniform(0.0, 0.15);
  return key;
}

RawMotion kneelOneKnee(Studio& studio) {
  const KeyPose knee = kneelingRight(studio);
  KeyPose step = standing(0.11);
  step.right_foot = knee.right_foot;
  step.right_foot.pitch = 0.7;
  step.left_foot = knee.left_foot;
  step.pelvis.y = -0.12;
  step.pelvis.z = -0.10;
  KeySequence s(knee);
  s.add(standing(0.11), 0.01);
  s.add(step, 0.7);
  s.base(0.8);
  KeyPose& gesture = s.then(0.7);
  gesture.right = randomReach(studio.random);
  gesture.left = {-0.02, -0.34, 0.26, 0.0};
  s.then(0.4);
  s.base(0.7);
  s.add(step, 0.8);
  s.add(standing(0.11), 0.8);
  s.then(0.2);
  return {studio.play(s, 0.02)};
}

RawMotion kneelBoth(Studio& studio) {
  KeyPose knees = standing(0.12);
  knees.left_foot = knees.right_foot = {.out = 0.12, .forward = -0.52, .pitch = 1.15, .toe_out = 0.0};
  knees.pelvis.y = -0.435;
  knees.pelvis.z = -0.08;
  knees.pelvis.held = 1.0;
  KeySequence s(knees);
  s.at(0.0);
  for (int i = 0; i < 6; ++i) {
    KeyPose& key = s.base(studio.uniform(0.7, 1.0));
    const bool heels = studio.chance(0.4);
    if (heels) {
      key.pelvis.y = -0.55;
      key.pelvis.z = -0.25;
    }
    key.pelvis.lean = studio.uniform(-0.05, 0.4);
    key.spine = {studio.uniform(-0.1, 0.4), studio.uniform(-0.3, 0.3), studio.uniform(-0.1, 0.1)};
    key.left = studio.chance(0.5) ? randomReach(studio.random) : kOnThigh;
    key.right = studio.chance(0.5) ? randomReach(studio.random) : kOnThigh;
    key.head.turn = studio.uniform(-0.5, 0.5);
  }
  return {studio.play(s, 0.02)};
}

RawMotion crouch(Studio& studio) {
  KeyPose low = standing(0.16);
  low.pelvis.y = -0.52;
  low.pelvis.z = -0.10;
  low.pelvis.lean = 0.35;
  low.spine.bend = 0.4;
  low.head.nod = -0.3;
  low.left_foot.pitch = low.right_foot.pitch = 0.35;
  low.left_foot.knee_out = low.right_foot.knee_out = 0.25;
  setHands(low, {-0.05, -0.30, 0.36, 0.0});
  KeySequence s(standing(0.16));
  s.at(0.0);
  s.add(low, 1.0);
  for (int i = 0; i < 4; ++i) {
    KeyPose& key = s.add(low, studio.uniform(0.5, 0.8));
    key.right = {studio.uniform(-0.1, 0.25), studio.uniform(-0.45, 0.1), studio.uniform(0.2, 0.42), 0.0};
    key.spine.twist = studio.uniform(-0.3, 0.3);
    key.head.turn = studio.uniform(-0.4, 0.4);
  }
  s.base(1.0);
  return {studio.play(s, 0.02)};
}

constexpr std::array kRecipes = {
    Recipe{"sit_and_stand", 3, &sitAndStand}, Recipe{"sit_and_talk", 2, &sitAndTalk},
    Recipe{"sit_and_move", 2, &sitAndMove},   Recipe{"kneel_one_knee", 2, &kneelOneKnee},
    Recipe{"kneel", 2, &kneelBoth},           Recipe{"crouch", 2, &crouch},
};

}  // namespace

std::span<const Recipe> sittingRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

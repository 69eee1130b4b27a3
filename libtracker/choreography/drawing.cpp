#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "libtracker/choreography/easing.h"
#include "libtracker/choreography/postures.h"
#include "libtracker/choreography/recipe.h"

// Hands led along lines: shapes drawn in the air, wiped windows, stirring, arm circles.

namespace depthmocap {
namespace {

struct Stroke {
  double right, up;  // in the drawing plane, -1 .. 1
};

// Where the drawing plane is before the (right) shoulder, and its size [m].
struct Canvas {
  double out, up, forward;
  double width, height;
};

Canvas randomCanvas(Studio& studio) {
  return {studio.uniform(-0.12, 0.06), studio.uniform(-0.10, 0.12), studio.uniform(0.32, 0.40),
          studio.uniform(0.16, 0.26), studio.uniform(0.18, 0.30)};
}

HandTarget onCanvas(const Canvas& canvas, const Stroke& at) {
  return {canvas.out + canvas.width * at.right, canvas.up + canvas.height * at.up, canvas.forward, 0.1};
}

BodyFrames standStill(Studio& studio, double duration_s) {
  KeySequence s(standing(studio.uniform(0.09, 0.18)));
  s.at(0.0);
  for (double t = 1.0; t < duration_s + 1.0; t += 1.0) s.then(1.0);
  BodyFrames frames =
      playKeys(studio.skeleton, s, {.hand_spread = 0.008, .angle_spread = 0.015, .heel_rise = 0.2}, studio.random);
  frames.resize(static_cast<std::size_t>(duration_s * kMotionFps) + 1);
  return frames;
}

// Straight strokes from corner to corner, each from rest to rest.
RawMotion drawCorners(Studio& studio, std::span<const Stroke> corners) {
  constexpr double kRaise = 0.7;  // [s]
  const double stroke_s = studio.uniform(0.42, 0.62);
  const Canvas canvas = randomCanvas(studio);
  const std::vector<Stroke> way(corners.begin(), corners.end());
  const auto path = [=](double t) {
    const double s = std::clamp((t - kRaise) / stroke_s, 0.0, static_cast<double>(way.size()) - 1.0);
    const auto k = std::min(static_cast<std::size_t>(s), way.size() - 2);
    const double u = minimumJerk(s - static_cast<double>(k));
    return onCanvas(canvas, {lerp(way[k].right, way[k + 1].right, u), lerp(way[k].up, way[k + 1].up, u)});
  };
  BodyFrames frames = standStill(studio, 2 * kRaise + stroke_s * static_cast<double>(way.size() - 1));
  guideHand(studio.skeleton, Side::Right, path, kRaise, 0.6, frames);
  return {frames};
}

RawMotion drawX(Studio& studio) {
  static constexpr std::array<Stroke, 6> kX = {{{-1, 1}, {1, -1}, {1, 1}, {-1, -1}, {-1, 1}, {1, -1}}};
  return drawCorners(studio, kX);
}
RawMotion drawTick(Studio& studio) {
  static constexpr std::array<Stroke, 6> kTick = {{{-1, 0.2}, {-0.3, -1}, {1, 1}, {-1, 0.2}, {-0.3, -1}, {1, 1}}};
  return drawCorners(studio, kTick);
}
RawMotion drawSquare(Studio& studio) {
  static constexpr std::array<Stroke, 8> kSquare = {
      {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}, {-1, 1}, {0, 1}, {1, -1}, {-1, -1}}};
  return drawCorners(studio, kSquare);
}
RawMotion writeZigzag(Studio& studio) {
  std::array<Stroke, 9> strokes;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const double across = -1.0 + 0.25 * static_cast<double>(i);
    strokes[i] = {across, i % 2 == 0 ? studio.uniform(0.2, 1.0) : studio.uniform(-1.0, -0.2)};
  }
  return drawCorners(studio, strokes);
}

// A closed curve run through several times: radius per axis, how often per round, both hands or one.
struct Orbit {
  HandTarget center;
  double out, up, forward;  // [m] radii
  double up_frequency = 1.0;
  double up_phase = 0.25;  // [cycles]
  double round_s = 1.6;
  double rounds = 2.5;
};

HandPath orbitPath(const Orbit& orbit, double phase) {
  return [=](double t) {
    const double cycles = t / orbit.round_s + phase;
    return HandTarget{orbit.center.out + orbit.out * wave(cycles),
                      orbit.center.up + orbit.up * wave(orbit.up_frequency * cycles - orbit.up_phase),
                      orbit.center.forward + orbit.forward * wave(cycles - 0.25), orbit.center.elbow};
  };
}

enum class Hands { Right, Both, Alternating };

RawMotion circleHands(Studio& studio, Orbit orbit, Hands hands, double follow) {
  orbit.round_s = studio.near(orbit.round_s, 0.2);
  BodyFrames frames = standStill(studio, orbit.rounds * orbit.round_s + 0.8);
  const double phase = studio.uniform(0, 1);
  guideHand(studio.skeleton, Side::Right, orbitPath(orbit, phase), 0.7, follow, frames);
  if (hands != Hands::Right) {
    guideHand(studio.skeleton, Side::Left, orbitPath(orbit, phase + (hands == Hands::Both ? 0.0 : 0.5)), 0.7, follow,
              frames);
  }
  return {frames};
}

RawMotion drawCircle(Studio& studio) {
  const Canvas c = randomCanvas(studio);
  return circleHands(studio, {{c.out, c.up, c.forward, 0.1}, c.width, c.width, 0.0},
                     studio.variant == 3 ? Hands::Both : Hands::Right, 0.6);
}
RawMotion drawEight(Studio& studio) {
  const Canvas c = randomCanvas(studio);
  return circleHands(studio,
                     {.center = {c.out, c.up, c.forward, 0.1},
                      .out = 0.26,
                      .up = 0.12,
                      .forward = 0.0,
                      .up_frequency = 2.0,
                      .round_s = 2.2,
                      .rounds = 2},
                     Hands::Right, 0.8);
}
RawMotion washWindow(Studio& studio) {
  const double up = studio.uniform(0.05, 0.22);
  return circleHands(
      studio, {{-0.02, up, 0.38, 0.2}, studio.uniform(0.15, 0.28), studio.uniform(0.12, 0.25), 0.0, 1.0, 0.25, 1.3, 3},
      studio.variant == 2 ? Hands::Alternating : Hands::Right, 0.5);
}
RawMotion stir(Studio& studio) {
  return circleHands(studio, {{-0.10, -0.28, 0.34, 0.3}, 0.12, 0.0, 0.10, 1.0, 0.25, 1.2, 3},
                     studio.variant == 1 ? Hands::Both : Hands::Right, 0.5);
}
// Straight arms, small to wide circles out to the sides.
RawMotion armCirclesSide(Studio& studio) {
  const double radius = studio.uniform(0.10, 0.25);
  return circleHands(studio, {{0.46, 0.02, 0.04, 0.0}, 0.0, radius, radius, 1.0, 0.0, 1.2, 3}, Hands::Both, 0.0);
}
// Windmills before the body and past the head.
RawMotion armCirclesFront(Studio& studio) {
  return circleHands(studio,
                     {{0.10, 0.05, 0.22, 0.1}, 0.34, 0.42, 0.0, 1.0, studio.chance(0.5) ? 0.25 : -0.25, 1.7, 2.5},
                     studio.variant % 2 == 0 ? Hands::Both : Hands::Alternating, 0.1);
}
RawMotion pedalHands(Studio& studio) {
  return circleHands(studio, {{-0.04, -0.12, 0.30, 0.1}, 0.0, 0.16, 0.14, 1.0, 0.0, 0.9, 4}, Hands::Alternating, 0.0);
}
RawMotion steer(Studio& studio) {
  return circleHands(studio, {{-0.02, -0.10, 0.36, 0.1}, 0.10, 0.14, 0.0, 1.0, 0.25, 1.8, 2.5}, Hands::Alternating,
                     0.4);
}

// Lissajous lines: the hand gets to every place before and beside the body.
RawMotion freeLines(Studio& studio) {
  const Orbit orbit{
      {studio.uniform(0.02, 0.16), studio.uniform(-0.05, 0.12), studio.uniform(0.20, 0.28), studio.uniform(-0.1, 0.4)},
      studio.uniform(0.2, 0.34),
      studio.uniform(0.25, 0.42),
      studio.uniform(0.0, 0.16),
      studio.uniform(1.3, 1.8),
      studio.uniform(0, 1),
      2.4,
      3};
  return circleHands(
      studio, orbit,
      studio.variant % 3 == 0 ? Hands::Right : (studio.variant % 3 == 1 ? Hands::Both : Hands::Alternating), 0.5);
}

constexpr std::array kRecipes = {
    Recipe{"draw_x", 2, &drawX},
    Recipe{"draw_tick", 2, &drawTick},
    Recipe{"draw_square", 2, &drawSquare},
    Recipe{"draw_zigzag", 2, &writeZigzag},
    Recipe{"draw_circle", 3, &drawCircle},
    Recipe{"draw_eight", 2, &drawEight},
    Recipe{"wash_window", 3, &washWindow},
    Recipe{"stir", 2, &stir},
    Recipe{"arm_circles_side", 2, &armCirclesSide},
    Recipe{"arm_circles_front", 2, &armCirclesFront},
    Recipe{"pedal_hands", 1, &pedalHands},
    Recipe{"steer", 1, &steer},
    Recipe{"free_lines", 6, &freeLines},
};

}  // namespace

std::span<const Recipe> drawingRecipes() {
  return kRecipes;
}

}  // namespace depthmocap

#include "libtracker/choreography/guided_hands.h"

#include <algorithm>

#include "libtracker/choreography/easing.h"
#include "libtracker/choreography/postures.h"

namespace depthmocap {
namespace {

constexpr double kRaise = 0.7;  // [s] the hand comes up and goes down again; by hand
constexpr double kRest = 0.8;   // [s] of an orbit, beyond its rounds; by hand

BodyFrames standStill(const Skeleton& skeleton, double duration_s, Random& random) {
  const KeyPose pose = standing(random.uniform(0.09, 0.18));
  KeySequence s;
  s.add(pose, 0.0);
  for (double t = 1.0; t < duration_s + 1.0; t += 1.0) s.add(pose, 1.0);
  BodyFrames frames = playKeys(skeleton, s, {.hand_spread = 0.008, .angle_spread = 0.015, .heel_rise = 0.2}, random);
  frames.resize(static_cast<std::size_t>(duration_s * kMotionFps) + 1);
  return frames;
}

HandPath orbitPath(const Orbit& orbit, double phase) {
  return [=](double t) {
    const double cycles = t / orbit.round_s + phase;
    return HandTarget{orbit.center.out + orbit.out * wave(cycles),
                      orbit.center.up + orbit.up * wave(orbit.up_frequency * cycles - orbit.up_phase),
                      orbit.center.forward + orbit.forward * wave(cycles - 0.25), orbit.center.elbow};
  };
}

HandTarget onPlane(const Strokes& plane, double right, double up) {
  return {plane.center.out + plane.width * right, plane.center.up + plane.height * up, plane.center.forward,
          plane.center.elbow};
}

}  // namespace

BodyFrames followOrbit(const Skeleton& skeleton, const Orbit& orbit, Random& random) {
  BodyFrames frames = standStill(skeleton, orbit.rounds * orbit.round_s + kRest, random);
  const double phase = random.uniform(0, 1);
  guideHand(skeleton, Side::Right, orbitPath(orbit, phase), kRaise, orbit.follow, frames);
  if (orbit.both) {
    guideHand(skeleton, Side::Left, orbitPath(orbit, phase + orbit.apart), kRaise, orbit.follow, frames);
  }
  return frames;
}

BodyFrames followStrokes(const Skeleton& skeleton, const Strokes& strokes, Random& random) {
  const auto& way = strokes.points;
  const auto path = [&](double t) {
    const double s = std::clamp((t - kRaise) / strokes.stroke_s, 0.0, static_cast<double>(way.size()) - 1.0);
    const auto k = std::min(static_cast<std::size_t>(s), way.size() - 2);
    const double u = minimumJerk(s - static_cast<double>(k));
    return onPlane(strokes, lerp(way[k].right, way[k + 1].right, u), lerp(way[k].up, way[k + 1].up, u));
  };
  const double duration_s = 2 * kRaise + strokes.stroke_s * static_cast<double>(way.size() - 1);
  BodyFrames frames = standStill(skeleton, duration_s, random);
  guideHand(skeleton, Side::Right, path, kRaise, strokes.follow, frames);
  return frames;
}

}  // namespace depthmocap

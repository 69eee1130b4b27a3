#include "libtracker/choreography/flight.h"

#include <algorithm>
#include <cmath>

#include "libtracker/choreography/easing.h"
#include "libtracker/choreography/postures.h"

namespace depthmocap {
namespace {

constexpr double kGravity = 9.81;  // [m/s^2]

}  // namespace

double airTime(double height) {
  return 2.0 * std::sqrt(2.0 * height / kGravity);
}

void fly(const Flight& flight, BodyFrames& frames) {
  const double duration = airTime(flight.height);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double t = static_cast<double>(i) / kMotionFps - flight.start_s;
    if (t <= 0) continue;
    const double u = std::min(1.0, t / duration);
    const double up = 4.0 * flight.height * u * (1.0 - u);
    BodyFrame& frame = frames[i];
    frame.pelvis.y += up;
    for (FootState* foot : {&frame.left_foot, &frame.right_foot}) foot->lift += up + flight.tuck * bump(u);
    displace(u * flight.sideways, u * flight.forward, flight.turn * smoothStep(u), frame);
  }
}

}  // namespace depthmocap

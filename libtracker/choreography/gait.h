#pragma once
#include <functional>

#include "libtracker/choreography/body_frame.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Where the pelvis should be at a time, and where the body faces.
struct PathPoint {
  double x = 0, z = 0;  // [m]
  double heading = 0;   // [rad]
};
using WalkPath = std::function<PathPoint(double time_s)>;

// The ground below a place [m]; stairs.
using GroundHeight = std::function<double(double x, double z)>;

// One way to walk or run. Angles [rad], lengths [m].
struct GaitStyle {
  double cycle_s = 1.08;      // [s] two steps
  double duty = 0.62;         // share of the cycle that a foot stands; below 0.5 the body flies
  double half_width = 0.075;  // of a foot from the line of travel
  double toe_out = 0.12;
  double passes_early = 0.03;  // [cycles] the body is over the foot this long before the middle of its stance
  double swing_carry = 0.2;  // [0, 1] how much a swinging foot goes with the body: 0 it comes to rest before touchdown
  double clearance = 0.025;  // lift of the toe in swing
  double foot_roll = 1.0;    // scales the pitch curve; < 0: backwards
  double foot_pitch = 0.0;   // added: tiptoe
  bool running = false;      // the pitch curve of running
  double bounce = -0.006;    // of the pelvis, > 0: lowest in the middle of stance
  double crouch = 0.0;       // the pelvis this much lower
  double sway = 0.022;       // of the pelvis to the standing leg
  double pelvis_turn = 0.07;
  double pelvis_list = 0.05;
  double lean = 0.04;
  double spine_bend = 0.03;
  double shoulder_turn = 0.10;  // against the pelvis
  double arm_swing = 0.40;
  double arm_forward = 0.05;  // middle of the swing
  double arm_out = 0.10;
  double elbow = 0.35;        // middle of the elbow's flexion
  double elbow_swing = 0.18;  // more flexion with the arm before the body
  double head_nod = 0.0;
  double always_active = 0.0;  // [0, 1] least activity, so that a gait on the spot does not stop
};

// Frames of a body that follows a path on foot. Every foot stands still from touchdown to lift-off, where the path
// passes it in the middle of its stance; where the path rests, the feet rest. Foot pitch over the cycle after Winter
// (2009).
BodyFrames walkAlong(const WalkPath& path, double duration_s, const GaitStyle& style, double first_phase,
                     const GroundHeight& ground = {});

// A straight path at a constant speed [m/s]; sideways > 0 to the left.
WalkPath straightPath(double forward, double sideways = 0.0, double turn_rate = 0.0);

}  // namespace depthmocap

#pragma once
#include <functional>

#include "libtracker/choreography/key_poses.h"

namespace depthmocap {

// Standing at ease, the ankles this far from the middle [m].
KeyPose standing(double half_width = 0.11);

// A place anywhere in the arm's reach that is not inside the trunk or the head.
HandTarget randomReach(Random& random);

// Leads a hand along a path, frame by frame, easing in and out over `ease_s`; the trunk and the head follow it by
// `follow` [0, 1].
using HandPath = std::function<HandTarget(double time_s)>;
void guideHand(const Skeleton& skeleton, Side side, const HandPath& path, double ease_s, double follow,
               BodyFrames& frames);

// Puts the arms of `arms` on `frames` (the shorter of both lasts), trunk movement added.
void overlayUpperBody(const BodyFrames& arms, BodyFrames& frames);

// Moves and turns a frame about the pelvis: everything that stands in the world.
void displace(double dx, double dz, double turn, BodyFrame& frame);

}  // namespace depthmocap

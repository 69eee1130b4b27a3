#pragma once
#include <functional>

#include "libtracker/choreography/key_poses.h"

namespace depthmocap {

// Hands [m] and stances that many motions share.
inline constexpr HandTarget kAtSide{0.10, -0.52, 0.06, 0.0};
inline constexpr HandTarget kOnHip{0.05, -0.36, 0.02, 0.55};
inline constexpr HandTarget kTPose{0.56, 0.03, 0.0, 0.0};
inline constexpr HandTarget kAPose{0.385, -0.41, 0.02, 0.0};
inline constexpr HandTarget kOverhead{-0.03, 0.63, 0.05, 0.0};
inline constexpr HandTarget kForward{-0.02, -0.02, 0.57, 0.0};
inline constexpr HandTarget kBeforeChest{-0.10, -0.16, 0.28, 0.2};
inline constexpr HandTarget kToFloor{-0.05, -0.12, 0.50, 0.0};  // of a body bent forward by a right angle
inline constexpr HandTarget kBeforeBelly{-0.06, -0.30, 0.28, 0.0};
inline constexpr HandTarget kBehindHead{-0.04, 0.20, -0.02, 0.4};
inline constexpr HandTarget kBehindBack{-0.08, -0.42, -0.16, 0.1};

// Standing at ease, the ankles this far from the middle [m].
KeyPose standing(double half_width = 0.11);

// The boxer's stance: left side before, fists before the chin, knees soft.
KeyPose boxingGuard();

// The arms of a key, both the same.
void setHands(KeyPose& key, const HandTarget& hand);

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

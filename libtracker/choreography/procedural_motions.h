#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "libtracker/skeleton/motion_clip.h"

namespace depthmocap {

// The project's own human motions, made from key postures, gait curves and inverse kinematics; no captured frame is in
// them. They feed the pose database that ships, the bundled recordings and the training of the forest. 30 fps, an
// average body, the floor at y = 0, starting near the origin and facing +z. All poses are within jointLimits(). The
// same name and seed give the same poses, whatever other motions are made.

// "walk", "walk_2", "walk_fast", ...: every motion with its variants.
std::vector<std::string> proceduralMotionNames();

// One motion. An unknown name is an Error that lists a near one.
MotionClip proceduralMotion(std::string_view name, std::uint64_t seed);

// All of them, in the order of proceduralMotionNames().
std::vector<MotionClip> proceduralMotions(std::uint64_t seed);

}  // namespace depthmocap

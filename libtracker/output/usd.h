#pragma once
#include <filesystem>
#include <vector>

#include "libtracker/output/gltf.h"

namespace depthmocap {

// Writes a USD file as text (.usda, UsdSkel): for each person a skeleton of the rig, the body as a skinned mesh, and
// the motion with the frames' own times. Metres, y up; what SkinRig and writeGltf say of rest pose and size holds here,
// too. Dots and colons in bones' names become underscores, as USD wants names. `fps` [1/s] (> 0) of the time codes.
// Written whole or not at all; Error names the file.
void writeUsd(const std::filesystem::path& path, const std::vector<AnimatedPerson>& people, double fps, RigStyle style);

}  // namespace depthmocap

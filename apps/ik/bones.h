#pragma once
#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// The conventions in which an answer can have all bones.
enum class BoneConvention { Gltf, Blender };
inline constexpr std::array<std::string_view, 2> kBoneConventionNames = {"gltf", "blender"};

// Every bone of a pose by its name in our BVH and glTF files; docs/reference/stream.md has the frames. Numbers are
// rounded to 1e-6.
// gltf: `parent`, `translation` [m], `rotation` [x, y, z, w], of the node in its parent, y up: what glTF calls TRS.
// blender: at rest `parent`, `head`, `tail` [m] and `z_axis` of the bone, z up, facing -y; and the pose of it in
// `location` [m] and `rotation_quaternion` [w, x, y, z], as the fields of a PoseBone are called.
nlohmann::json bonesOf(BoneConvention convention, const Skeleton& skeleton, const Pose& q);

}  // namespace depthmocap

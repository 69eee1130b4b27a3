#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/body/body_surface.h"
#include "libtracker/motion/rig.h"
#include "libtracker/output/motion_track.h"

namespace depthmocap {

// A binary glTF 2.0 file: the skeleton of a SkinRig, the body as a skinned mesh,
// and the motion as one animation with the frames' own times, from the first frame on. Metres, y up, facing +z; the
// rest pose is that of the rig with its feet on y = 0, the motion is in the world of the track. While the size is still
// being found, a scale of the hips says so. Twist: `RightArmUntwisted` and its like carry the skin of a limb's root.
// A track without frames gives a body without animation. The same input gives the same bytes.
std::string gltfBytes(const BodySurface& body, const MotionTrack& track, RigStyle style = RigStyle::MotionBuilder);

// One of the people of a file.
struct AnimatedPerson {
  int number = 1;  // in the names of armature and mesh, where it is not 1
  BodySurface body;
  MotionTrack track;
};

// Several people, each with a skeleton, a skin and channels of one animation of their own; times count from the first
// frame of all. Written whole or not at all; Error names the file.
void writeGltf(const std::filesystem::path& path, const std::vector<AnimatedPerson>& people,
               RigStyle style = RigStyle::MotionBuilder);

}  // namespace depthmocap

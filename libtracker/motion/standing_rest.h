#pragma once
#include "libtracker/motion/bone_names.h"
#include "libtracker/motion/source_motion.h"

namespace depthmocap {

// The same motion with bone frames in which identity rotations are a person who stands along the world's up axis.
// Where that is so already, nothing changes. Else the joints' own axes lie elsewhere (along the bones: LAFAN1, Rokoko),
// or the file's rest pose is upright about another axis than its motion: then the rest pose becomes the frame in which
// the body is most like a T-pose, and up the axis along which trunks mostly point. Adds to the motion's warnings what
// it guesses. Joint positions of all frames stay. `named` must hold upper arms and legs of both sides and the head.
SourceMotion withStandingRest(SourceMotion motion, const NamedBones& named);

}  // namespace depthmocap

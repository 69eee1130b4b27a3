#pragma once
#include "libtracker/motion/bone_names.h"
#include "libtracker/motion/source_motion.h"

namespace depthmocap {

// Whether the bones that are named left lie on the right of the body: files with a negative scale, and such whose names
// were exchanged. Toes point forward and knees bend forward, whatever is said of the sides.
bool sidesAreMirrored(const SourceMotion& motion, const NamedBones& named);

}  // namespace depthmocap

#pragma once
#include <vector>

#include "libtracker/clinical/angles_file.h"

namespace depthmocap {

// What places of joints alone say of angles: flexion of knees and elbows, dorsiflexion, and thighs and upper arms
// against the trunk, which stands in for the pelvis. Everything else is NaN. The camera is taken to stand level.
std::vector<AnglesRow> anglesOfJoints(const std::vector<JointsRow>& rows);

}  // namespace depthmocap

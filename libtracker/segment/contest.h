#pragma once
#include <vector>

#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/identity.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {

// Decides whose the surface is where the expected bodies of several people are near each other: the nearest body's.
// Memory alone (IdentityMemory) leaks from one to the other while they touch. `known`: one identity per cell; changed
// where it is one of theirs, or unknown.
void settleContest(const CoarseCloud& cloud, const ExpectedPeople& expected, std::vector<Identity>& known);

}  // namespace depthmocap

#pragma once
#include <string>

#include "depthmocap/skeleton.h"

namespace depthmocap {

// Throws Error unless every bone has a length that a body may have, and every joint lies within it.
void checkSkeleton(const Skeleton& skeleton, const std::string& where);

}  // namespace depthmocap

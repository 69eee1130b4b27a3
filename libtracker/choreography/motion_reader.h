#pragma once
#include <string>
#include <string_view>

#include "libtracker/choreography/motion_script.h"

namespace depthmocap {

// Reads a motion file; docs/reference/motions.md has the format. `name` is the file's name in errors; places and parts
// of `shared` may be used. Whatever is wrong in the file is an Error that names file, motion and key.
MotionFile readMotionFile(std::string_view text, const std::string& name, const MotionFile& shared = {});

}  // namespace depthmocap

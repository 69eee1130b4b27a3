#pragma once
#include <string_view>

namespace depthmocap {

// The bytes of libtracker/actor/models/bodies.bin, built into the library (cmake/Embed.cmake).
std::string_view embeddedBodies();

}  // namespace depthmocap

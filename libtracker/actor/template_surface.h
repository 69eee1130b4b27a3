#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "depthmocap/bone_lengths.h"
#include "depthmocap/surface_model.h"

namespace depthmocap {

// A sampled body: what a BodyTemplate is made from. libtracker/body makes it from the built-in human; the three that
// the tracker needs are stored, so that tracking needs neither the human's generator nor its libraries.
struct TemplateSurface {
  // A point of the skin where the body ends, in its bone's frame.
  struct End {
    Bone bone = Bone::Root;
    Part part = Part::None;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();  // [m]
    Eigen::Vector3d n = Eigen::Vector3d::Zero();  // unit, outwards
  };
  static constexpr std::size_t kEndCount = 5;  // crown, left and right fingertips, left and right soles
  BoneLengths lengths;
  SurfaceModel surface;
  std::array<End, kEndCount> ends;
};

// The bodies that come with the library: the average actor's, a man and a woman for calibrations.
struct ShippedBodies {
  TemplateSurface average, man, woman;
};
const ShippedBodies& shippedBodies();

// The file that holds them (libtracker/actor/models/bodies.bin): `depthmocap body-templates` writes it anew.
std::string shippedBodiesToBytes(const ShippedBodies& bodies);
// Throws Error where the bytes are not such a file.
ShippedBodies shippedBodiesFromBytes(std::string_view bytes);

}  // namespace depthmocap

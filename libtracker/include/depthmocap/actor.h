#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "depthmocap/body_shape.h"
#include "depthmocap/export.h"
#include "depthmocap/skeleton.h"
#include "depthmocap/surface_model.h"

namespace depthmocap {

// How a body was measured, as its actor file holds it.
struct ActorMeasurement {
  // How good the calibration is.
  struct Fit {
    int tpose_frames = 0;   // used
    int other_frames = 0;   // in other poses
    double surface_m = 0;   // [m] root mean square distance of the depth points from the fitted surface
    double marker_m = 0;    // [m] root mean square distance of the seen markers from the fitted ones
    double confidence = 0;  // [0, 1]
  };
  Sex sex = Sex::Male;                      // of the template whose surface fits better
  ShapeVector shape = ShapeVector::Zero();  // bone lengths [m], then girths
  // Radii of the fitted cylinders [m]; the trunk's cylinder is elliptic. 0: not fitted.
  double upper_arm_radius_m = 0, lower_arm_radius_m = 0, upper_leg_radius_m = 0, lower_leg_radius_m = 0;
  double torso_half_width_m = 0, torso_half_depth_m = 0;
  // The stature that was given over the stature that the calibrating camera measured. 1 where none was given, or where
  // both agree as well as a calibration can tell.
  double depth_scale = 1.0;
  std::string camera;  // name of the calibrating camera; may be empty
  Fit fit;
};

// A body to track: its sizes, where its markers sit, and its surface. Cheap to copy; copies share the surface.
struct Actor {
  Skeleton skeleton;
  MarkerModel markers;
  PartRadii radii_m{};
  // Points of the skin; never null in an actor that a function of this page returned. It is stretched to the stature of
  // the skeleton, so that one surface serves an actor whose size is still being fitted.
  std::shared_ptr<const SurfaceModel> surface;
  // How the body was measured. Null: a body of average proportions.
  std::shared_ptr<const ActorMeasurement> measured;

  [[nodiscard]] double stature_m() const { return statureOf(skeleton.lengths); }
};

// A body of average proportions of this stature [m] (1.0 .. 2.2). Throws Error for another stature.
DEPTHMOCAP_API Actor averageActor(double stature_m);

// Reads an actor file (JSON, docs/reference/formats.md). Optional entries take the average body's value; the format,
// the version and nine bone lengths are required. The body is as tall as the file says; Tracker and Session track it as
// tall as the camera sees it (asSeen). Throws Error naming the file and the key: a missing file, no JSON, another
// format, a length outside 5 mm .. 1.5 m, a stature that differs from the bones' by more than 5 %, an unknown bone or
// part.
DEPTHMOCAP_API Actor readActorFile(const std::filesystem::path& path);

// Writes a measured actor, whole or not at all. Throws Error where the file cannot be written or the actor was not
// measured.
DEPTHMOCAP_API void writeActorFile(const std::filesystem::path& path, const Actor& actor);

// The same body as tall as the calibrating camera saw it, whose depth may be a few per cent off: scaled by
// 1 / depth_scale. An average actor is returned as it is.
DEPTHMOCAP_API Actor asSeen(const Actor& actor);

}  // namespace depthmocap

#pragma once
#include <array>
#include <filesystem>
#include <string>

#include "calibration/body_template.h"
#include "libtracker/tracker/actor_model.h"

namespace depthmocap {

// A calibrated body as an actor file holds it.
struct CalibratedActor {
  // How good the calibration is.
  struct Fit {
    int tpose_frames = 0;   // used
    int other_frames = 0;   // in other poses
    double surface_m = 0;   // [m] root mean square from cloud to fitted surface
    double marker_m = 0;    // [m] root mean square of the markers
    double confidence = 0;  // [0, 1] how sure
  };
  Sex sex = Sex::Male;                      // of the template whose surface fits better
  ShapeVector shape = ShapeVector::Zero();  // bone lengths [m] and girths
  ActorModel model;
  // Of the fitted cylinders [m]; the trunk's is elliptic. 0 = not fitted.
  double upper_arm_radius_m = 0, lower_arm_radius_m = 0, upper_leg_radius_m = 0, lower_leg_radius_m = 0;
  double torso_half_width_m = 0, torso_half_depth_m = 0;
  // Stature that was given over the one that the calibrating camera measured; 1 where none was given or where they
  // agree as well as a calibration can tell. Tracking takes the body 1 / depth_scale times as large, as that camera
  // sees it.
  double depth_scale = 1.0;
  std::string camera;
  Fit fit;

  [[nodiscard]] double stature() const { return statureOf(model.skeleton.lengths); }
};

// An actor of these bone lengths and girths with an average body's marker offsets; its part radii follow the girths.
ActorModel actorOfShape(const BodyTemplate& body, const ShapeVector& shape);

// The same body `factor` times as large, all of it but depth_scale and fit.
CalibratedActor scaledActor(CalibratedActor actor, double factor);

// JSON, version 1 (docs/formats.md). What an actor file may leave out takes the average body's value of that stature;
// needed are the format, the version and the nine bone lengths of the contract. Every complaint is an Error that names
// the file and the key: a file that is missing, no JSON, of another format, with a length outside 1 cm .. 1.5 m, a
// stature that differs from the bones' by more than 5 %, an unknown bone or part, a number that is not finite.
CalibratedActor readActorFile(const std::filesystem::path& path);
// Whole or not at all.
void writeActorFile(const std::filesystem::path& path, const CalibratedActor& actor);

// The number of points of the surface that tracking compares depth with, and the surface itself.
SurfaceModel actorSurface(const CalibratedActor& actor, int points);

}  // namespace depthmocap

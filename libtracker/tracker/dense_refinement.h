#pragma once
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "libtracker/core/classified_pixels.h"
#include "libtracker/match/free_space_matcher.h"
#include "libtracker/match/surface_matcher.h"
#include "libtracker/skeleton/surface_model.h"
#include "libtracker/solve/map_solver.h"
#include "libtracker/tracker/actor_model.h"

namespace depthmocap {

// Beyond the paper: brings the body's surface to the measured points, as iterated closest points do: match, solve (5)
// with the dense term, match again.
class DenseRefinement {
 public:
  // `rounds` of matching and solving (>= 0; 0 = off).
  DenseRefinement(const SurfaceMatchConfig& surface, const FreeSpaceConfig& free_space, int rounds)
      : matcher_(surface), free_space_(free_space), rounds_(rounds) {}

  // Takes the frame: a few hundred of its classified pixels, spread evenly, and what is free of the actor. Depth and
  // mask must outlive the calls for this frame.
  void observe(const ClassifiedPixels& pixels, const DepthImage& depth, const MaskImage& mask,
               const CameraModel& camera, const Eigen::Matrix3d& R_world_camera);
  // q: a solved pose, then the refined one. `input` without its surface; `summary` is replaced where a round was done.
  void refine(const SurfaceModel& surface, const ActorModel& actor, MapInput input, MapSolver& solver, Pose& q,
              MapSummary& summary);

  // How much taller the measured person stands than the model at the solved pose: the ratio of their vertical extents.
  // 0 if it cannot be told (too little of the person in view). Needs the whole person in view.
  [[nodiscard]] double extentRatio(const SurfaceModel& surface, const ActorModel& actor, const Pose& q);

 private:
  void place(const SurfaceModel& surface, const ActorModel& actor, const Pose& q);

  SurfaceMatcher matcher_;
  FreeSpaceMatcher free_space_;
  int rounds_;
  std::vector<SurfaceSample> samples_;
  SurfaceMatches matches_;
  ForwardKinematics fk_;
  PlacedSurface placed_;
  std::vector<float> heights_;  // [m] world y of every classified pixel
  double observed_extent_m_ = 0;
};

}  // namespace depthmocap

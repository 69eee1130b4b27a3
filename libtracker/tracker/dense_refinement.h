#pragma once
#include <span>
#include <vector>

#include "depthmocap/actor.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "libtracker/core/classified_pixels.h"
#include "libtracker/match/free_space_matcher.h"
#include "libtracker/match/match_noise.h"
#include "libtracker/match/outline_matcher.h"
#include "libtracker/match/surface_matcher.h"
#include "libtracker/solve/map_solver.h"

namespace depthmocap {

// What decides which point of the surface a measured point belongs to: the distance and the parts that the classifier
// sees, or the distance alone.
enum class Matching { ByParts, ByDistance };

// Beyond the paper: brings the body's surface to the measured points, as iterated closest points do: match, solve (5)
// with the dense term, match again.
class DenseRefinement {
 public:
  // `rounds` of matching and solving (>= 0; 0 = off).
  DenseRefinement(const SurfaceMatchConfig& surface, const OutlineConfig& outline, const FreeSpaceConfig& free_space,
                  int rounds);

  // The frame, for what is free of the actor in it. Depth and mask must outlive the calls for this frame. `whole`
  // false: the mask may lack the legs.
  void look(const DepthImage& depth, const MaskImage& mask, bool whole, const CameraModel& camera,
            const Eigen::Matrix3d& R_world_camera);
  // q: a solved pose, then the refined one. `input` without its surface; `summary` is replaced where a round was done.
  void refine(const std::vector<SurfaceSample>& samples, Matching matching, const Actor& actor, MapInput input,
              MapSolver& solver, Pose& q, MapSummary& summary);
  // The matches are again those of the refine() before the last one.
  void takeBack();
  // How badly a pose explains the samples of the last refine() and the image: 0 = all of it, 1 = nothing.
  [[nodiscard]] double misfit(const Actor& actor, const Pose& q);

  // The last refine() fits: how far its matches lie off weighs those of the frames to come.
  void learnNoise(const Actor& actor, const Pose& q);
  // What was learned of the camera's noise is of another run.
  void forget();

  // The matches of the last refine(); null: it made none.
  [[nodiscard]] const SurfaceMatches* matches() const { return rounds_ > 0 ? &matches_ : nullptr; }

  // Those of measured points, and of lines of sight past the body.
  [[nodiscard]] std::span<const SurfaceMatch> measured() const { return std::span(matches_).first(measured_); }
  [[nodiscard]] std::span<const SurfaceMatch> outline() const {
    return std::span(matches_).subspan(measured_, touched_);
  }

  // How much taller the measured person stands than the model at the solved pose: the ratio of their vertical extents.
  // 0 if it cannot be told (too little of the person in view). Needs the whole person in view.
  [[nodiscard]] double extentRatio(const ClassifiedPixels& pixels, const Actor& actor, const Pose& q);

 private:
  SurfaceMatcher matcher_;
  OutlineMatcher outline_;
  FreeSpaceMatcher free_space_;
  int rounds_;
  SurfaceMatches matches_, matches_before_;
  std::size_t measured_ = 0, measured_before_ = 0;  // of them, the first ones
  std::size_t touched_ = 0, touched_before_ = 0;    // of the outline, the next ones; the others are of free space
  MatchNoise noise_;                                // of measured points, and of the outline
  MatchNoise outline_noise_;
  ForwardKinematics fk_;
  PlacedSurface placed_;
  CameraModel camera_;
  bool whole_ = true;
  Eigen::Matrix3d R_world_camera_ = Eigen::Matrix3d::Identity();
  std::vector<float> heights_;  // [m] world y of every classified pixel
};

}  // namespace depthmocap

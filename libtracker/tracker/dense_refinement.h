#pragma once
#include <optional>
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

// How tall somebody stands.
struct ExtentEvidence {
  double ratio = 0;        // of the vertical extent that is measured over the model's
  double uprightness = 0;  // the model's extent over its stature; 0 if too little is in view
};

// How often the surface is matched and (5) is solved.
struct DenseRounds {
  int count = 0;  // (>= 0) of matching and solving
  int steps = 1;  // (>= 1) at most so many of the solver in each
};

// Beyond the paper: brings the body's surface to the measured points, as iterated closest points do: match, solve (5)
// with the dense term, match again.
class DenseRefinement {
 public:
  // `on` false: nothing is matched.
  DenseRefinement(const SurfaceMatchConfig& surface, const OutlineConfig& outline, const FreeSpaceConfig& free_space,
                  bool on);

  // The frame, for what is free of the actor in it. Depth and mask must outlive the calls for this frame. `whole`
  // false: the mask may lack the legs.
  void look(const DepthImage& depth, const MaskImage& mask, bool whole, const CameraModel& camera,
            const Eigen::Matrix3d& R_world_camera);
  // q: a solved pose, then the refined one. `input` without its surface; `summary` is replaced where a round was done.
  void refine(const std::vector<SurfaceSample>& samples, Matching matching, const Actor& actor, MapInput input,
              MapSolver& solver, DenseRounds rounds, Pose& q, MapSummary& summary);
  // The matches are again those of the refine() before the last one; not twice in a row.
  void takeBack();
  // [0, 2] What a pose leaves unexplained of the samples of the last refine(), and how much of its body hangs in free
  // space: each 0 = nothing, 1 = all of it. None without rounds: nothing was matched then.
  [[nodiscard]] std::optional<double> misfit(const Actor& actor, const Pose& q);

  // The last refine() fits: how far its matches lie off weighs those of the frames to come.
  void learnNoise(const Actor& actor, const Pose& q);
  // What was learned of the camera's noise is of another run.
  void forget();

  // The matches of the last refine(); null: it made none.
  [[nodiscard]] const SurfaceMatches* matches() const { return on_ ? &pairs_.matches : nullptr; }

  // Those of measured points, and of lines of sight past the body.
  [[nodiscard]] std::span<const SurfaceMatch> measured() const {
    return std::span(pairs_.matches).first(pairs_.measured);
  }
  [[nodiscard]] std::span<const SurfaceMatch> outline() const {
    return std::span(pairs_.matches).subspan(pairs_.measured, pairs_.touched);
  }

  // Needs the whole person in view, at the solved pose.
  [[nodiscard]] ExtentEvidence extent(const ClassifiedPixels& pixels, const Actor& actor, const Pose& q);

 private:
  struct Pairs {
    SurfaceMatches matches;
    std::size_t measured = 0;  // of them, the first ones are of measured points,
    std::size_t touched = 0;   // the next ones of the outline, the others of free space
  };

  SurfaceMatcher matcher_;
  OutlineMatcher outline_;
  FreeSpaceMatcher free_space_;
  bool on_;
  Pairs pairs_, pairs_before_;  // of the last refine(), and of the one before it
  MatchNoise noise_;            // of measured points, and of the outline
  MatchNoise outline_noise_;
  ForwardKinematics fk_;
  PlacedSurface placed_;
  CameraModel camera_;
  bool whole_ = true;
  Eigen::Matrix3d R_world_camera_ = Eigen::Matrix3d::Identity();
  std::vector<float> heights_;  // [m] world y of every classified pixel
};

}  // namespace depthmocap

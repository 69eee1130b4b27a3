#pragma once
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/match/placed_surface.h"
#include "libtracker/match/silhouette.h"
#include "libtracker/skeleton/surface_match.h"

namespace depthmocap {

struct FreeSpaceConfig {
  double margin_m = 0.03;  // [m] (>= 0) the body may reach so far into free space without a penalty
  double sigma_m = 0.05;   // [m] (> 0) of the Lorentzian that weighs a violation by its size
  double weight = 0.3;     // (0, 1] of a small violation, against a surface match
  int max_matches = 150;   // (0 .. kMaxSurfaceMatches) 0 = off
  std::vector<ConfigField> fields();
  void validate() const;  // throws Error naming field, value and rule
};

// The other direction of the dense term: where the camera looks through to something farther away, or past the actor,
// there is no body. Each surface point that stands in such free space is pulled back: behind the measured depth, or
// sideways into the actor's outline. Without this a limb that nothing supports may hang in the air.
class FreeSpaceMatcher {
 public:
  explicit FreeSpaceMatcher(const FreeSpaceConfig& config);

  // The frame; both images must outlive the calls of match().
  void observe(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera,
               const Eigen::Matrix3d& R_world_camera);
  // Appends the violations of a placed body, spread evenly where there are more than max_matches. `whole` false: the
  // mask may lack legs though they are in view (below a table), and those far from it are not judged.
  void match(const PlacedSurface& placed, bool whole, SurfaceMatches& matches);
  // [0, 1] How much of a placed body hangs in free space: the mean over its points of the squared distance to where
  // they could be, over reach_m [m]; 1 from there on.
  [[nodiscard]] double hanging(const PlacedSurface& placed, bool whole, double reach_m) const;

 private:
  struct Violation {
    Eigen::Vector3d target_world;     // [m]
    Eigen::Vector3d direction_world;  // unit, from the target towards the point
    double size_m = 0;                // 0: none
  };
  [[nodiscard]] Violation check(const Eigen::Vector3f& p_world) const;

  FreeSpaceConfig config_;
  Silhouette silhouette_;
  const DepthImage* depth_ = nullptr;
  const MaskImage* mask_ = nullptr;
  CameraModel camera_;
  Eigen::Matrix3d R_world_camera_ = Eigen::Matrix3d::Identity();
  SurfaceMatches found_;
};

}  // namespace depthmocap

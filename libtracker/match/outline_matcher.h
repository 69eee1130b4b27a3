#pragma once
#include <Eigen/Core>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "depthmocap/surface_model.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/surface_match.h"

namespace depthmocap {

struct OutlineConfig {
  double weight = 1.2;           // (> 0) of a perfect match against a match of depth
  double max_distance_m = 0.08;  // [m] (> 0) a line of sight that passes the body further away has no match
  double sigma_m = 0.02;         // [m] (> 0) of the Lorentzian that weighs a match by its distance
  int max_matches = 400;         // (0 .. kMaxSurfaceMatches) spread evenly; 0 = off
  std::vector<ConfigField> fields();
  void validate() const;  // throws Error naming field, value and rule
};

// Pairs the actor's outline in the image with the points of the body where it turns away from the camera: each outline
// pixel is a line of sight that touches the body. It tells widths and lengths better than depth does, which is coarse
// and smoothed near the outline. Reuse one object: nothing is allocated after its first calls.
class OutlineMatcher {
 public:
  explicit OutlineMatcher(const OutlineConfig& config);

  // The frame; `mask`: the actor's pixels. Outline is where something further away, or nothing measured, is beside it.
  void observe(const DepthImage& depth, const MaskImage& mask, const CameraModel& camera,
               const Eigen::Matrix3d& R_world_camera);
  // `surface` stretched by `scale` in the pose of `fk`. A match's normal is at right angles to its line of sight, and
  // its measured point lies on the line. Appends to `matches`.
  void match(const SurfaceModel& surface, double scale, const ForwardKinematics& fk, SurfaceMatches& matches);

 private:
  struct Pixel {
    Eigen::Vector2f place;    // [px]
    Eigen::Vector2f outward;  // unit, in the image
    float depth_m = 0;
  };
  struct Rim {
    Eigen::Vector2f place;    // [px]
    Eigen::Vector2f outward;  // unit, in the image
    float depth_m = 0;
    Eigen::Vector3f p_camera;  // [m]
    Eigen::Vector3f n_camera;  // unit, at right angles to the line of sight
    const SurfaceModel::Point* point = nullptr;
    Part part = Part::None;
  };
  void findRim(const SurfaceModel& surface, double scale, const ForwardKinematics& fk);
  [[nodiscard]] const Rim* nearestRim(const Pixel& pixel) const;  // null: none near enough

  OutlineConfig config_;
  CameraModel camera_;
  Eigen::Matrix3d R_world_camera_ = Eigen::Matrix3d::Identity();
  std::vector<Pixel> found_;
  std::vector<Pixel> outline_;
  std::vector<Rim> rim_;
};

}  // namespace depthmocap

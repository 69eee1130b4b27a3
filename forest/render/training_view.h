#pragma once
#include <Eigen/Geometry>
#include <vector>

#include "depthmocap/pose.h"
#include "forest/render/depth_renderer.h"
#include "forest/render/sensor_model.h"
#include "libtracker/body/body_surface.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// One picture to learn from: the actor and what he carries. What is behind him, before him and not measured is 0 in
// both images.
struct TrainingView {
  DepthImage depth;  // [m]
  PartImage parts;   // Part; None where he carries something
  CameraModel camera;
  SensorKind sensor = SensorKind::Kinect1;
  Pose q_world = Pose::Zero();  // what was rendered; world: y up, the floor at y = 0, the camera above the origin
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();
};

// From where a pose is looked at. Ranges are uniform.
struct TrainingViewConfig {
  double min_distance_m = 0.8;       // [m] camera to the middle of the body, along the floor
  double max_distance_m = 4.5;       // [m]
  double min_camera_height_m = 0.3;  // [m]
  double max_camera_height_m = 2.2;  // [m]
  double max_tilt = 0.7;             // [rad] of the camera, up or down
  double max_roll = 0.05;            // [rad]
  double facing_share = 0.35;        // [0, 1] of the pictures within facing_range of the camera, the others anywhere
  double facing_range = 1.0;         // [rad]
  double cut_share = 0.12;           // [0, 1] of the pictures moved sideways out of the image, partly
  double carried_share = 0.12;       // [0, 1] of the pictures with a bag or something in a hand
  double obstacle_share = 0.12;      // [0, 1] of the pictures with something between actor and camera
  double noise_share = 0.9;          // [0, 1] of the pictures with sensor noise
  double min_focal_scale = 0.78;     // times the nominal focal length
  double max_focal_scale = 1.05;
};

// Renders random views of poses. Use one object per thread; results depend on the arguments alone.
class TrainingViewRenderer {
 public:
  explicit TrainingViewRenderer(const TrainingViewConfig& config = {}) : config_(config) {}

  // Of q only the body's DoFs and the root's tilt are used; where the actor stands and where he looks is drawn.
  void render(const BodySurface& body, const Pose& q, Random& random, TrainingView& view);

 private:
  void drawCamera(Random& random, TrainingView& view) const;
  void placeActor(const BodySurface& body, const Pose& q, Random& random, TrainingView& view);
  void aimCamera(double distance_m, Random& random, TrainingView& view) const;
  [[nodiscard]] TriangleMesh drawProps(const Skeleton& skeleton, const Pose& q_world, Random& random) const;

  TrainingViewConfig config_;
  DepthRenderer renderer_;
  SensorModel kinect1_{SensorKind::Kinect1};
  SensorModel kinect2_{SensorKind::Kinect2};
  RenderedView clean_;
  std::vector<Eigen::Vector3f> vertices_;
};

}  // namespace depthmocap

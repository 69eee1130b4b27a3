#pragma once
#include <Eigen/Geometry>
#include <functional>
#include <span>
#include <vector>

#include "depthmocap/pose.h"
#include "forest/render/room_occupancy.h"
#include "forest/render/scene_kind.h"
#include "forest/render/sensor_model.h"
#include "libtracker/body/body_surface.h"
#include "libtracker/core/random.h"

namespace depthmocap {

// One picture of a furnished room with its truth.
struct SceneView {
  DepthImage depth;   // [m], 0 = no measurement
  PartImage classes;  // 0 background, Part of the actor, kOtherPerson of anybody else
  CameraModel camera;
  SensorKind sensor = SensorKind::Kinect1;
  SceneKind scene = SceneKind::Empty;
  Eigen::Isometry3d T_camera_world = Eigen::Isometry3d::Identity();  // world: y up, the camera at the origin
  Pose q_world = Pose::Zero();                                       // of the actor; zero where nobody is there
};

// The class of a person who is not the actor.
inline constexpr std::uint8_t kOtherPerson = kPartCount + 1;

// Ranges are uniform.
struct SceneViewConfig {
  int most_pixels = 320;             // [px] the longer side of a picture
  double min_distance_m = 1.0;       // [m] camera to the actor, along the floor
  double max_distance_m = 4.5;       // [m]
  double min_camera_height_m = 0.4;  // [m]
  double max_camera_height_m = 2.2;  // [m]
  double max_tilt = 0.61;            // [rad] of the camera, up or down
  double max_roll = 0.05;            // [rad]
  double empty_share = 0.15;         // [0, 1] of the pictures without anybody
  double other_share = 0.3;          // [0, 1] of the others with a second person
  double lying_share = 0.05;         // [0, 1] of the actors, who lie on a bed or on the floor whatever their pose
  double facing_share = 0.5;         // [0, 1] of the people within 1 rad of facing the camera, the others anywhere
};

// Renders random furnished rooms by all named cameras for learning. Use one object per thread; results depend on the
// arguments alone.
class SceneViewRenderer {
 public:
  explicit SceneViewRenderer(const SceneViewConfig& config = {}) : config_(config) {}

  // bodies: at least one. `draw` gives poses, of which the body's DoFs and the root's tilt are used.
  void render(std::span<const BodySurface> bodies, const std::function<Pose(Random&)>& draw, Random& random,
              SceneView& view);

 private:
  struct Person {
    const BodySurface* body = nullptr;
    Pose q = Pose::Zero();
    Eigen::AlignedBox3d bounds;  // [m] in the world
    bool lies = false;
  };

  void drawCamera(Random& random, SceneView& view) const;
  Person drawPerson(std::span<const BodySurface> bodies, const std::function<Pose(Random&)>& draw, Random& random);
  void placePerson(const Eigen::Vector2d& where, double floor_y, double lift_m, Person& person);
  void addPerson(const Person& person, int id, TriangleMesh& scene);
  void aimCamera(const Person& actor, double floor_y, Random& random, SceneView& view) const;

  SceneViewConfig config_;
  DepthRenderer renderer_;
  RenderedView clean_;
  std::vector<SensorModel> sensors_;  // by SensorKind
  std::vector<Eigen::Vector3f> vertices_;
};

}  // namespace depthmocap

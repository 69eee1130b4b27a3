#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "forest/render/sensor_model.h"
#include "forest/render/stereo_sensor.h"
#include "libtracker/body/body_surface.h"
#include "libtracker/core/random.h"
#include "libtracker/core/room_class.h"

namespace depthmocap {

// One picture of a furnished room, with people or without.
struct RoomView {
  DepthImage depth;   // [m]; 0 = no measurement
  PartImage classes;  // RoomClass
  CameraModel camera;
};

// Ranges are uniform.
struct RoomViewConfig {
  int width = 160;                   // [px] of a picture; height by the sensor's shape
  double empty_share = 0.2;          // [0, 1] of the pictures without anybody
  double company_share = 0.4;        // [0, 1] of the pictures with people that have more than one
  int most_people = 5;               // (>= 2)
  double sitter_share = 0.2;         // [0, 1] of the people whose pose is drawn anew until it sits
  double min_distance_m = 0.6;       // [m] camera to the actor, along the floor
  double max_distance_m = 4.6;       // [m]
  double min_camera_height_m = 0.3;  // [m]
  double max_camera_height_m = 2.3;  // [m]
  double max_tilt = 0.6;             // [rad] of the camera, up or down
  double max_depth_m = 6.0;          // [m] farther measurements are none, as SegmentConfig has it
};

// Renders random furnished rooms of seven kinds of camera: Kinect v1 and v2, and active stereo, filled or not, of
// several widths of view. People sit on seats, lie on beds, stand behind and beside furniture. Use one object per
// thread; results depend on the arguments alone.
class RoomViewRenderer {
 public:
  explicit RoomViewRenderer(const RoomViewConfig& config = {}) : config_(config) {}

  // Draws poses by `draw`, of which the body's DoFs and the root's tilt are used.
  void render(std::span<const BodySurface> bodies, const std::function<Pose(Random&)>& draw, Random& random,
              RoomView& view);

 private:
  struct Person;
  struct Extent;
  enum class Camera { Kinect1, Kinect2, StereoFilled, StereoRaw };

  void drawCamera(Random& random, RoomView& view);
  void placePeople(std::span<const BodySurface> bodies, const std::function<Pose(Random&)>& draw, Random& random,
                   const RoomView& view);
  void placeActor(const BodySurface& body, Pose q, const Eigen::Vector2d& place, Random& random);
  void supportActor(const BodySurface& body, const Pose& q, Random& random);
  void addRoom(Random& random);
  void addFurniture(Random& random);
  void aim(Random& random, const RoomView& view);
  void sense(Random& random, RoomView& view);

  RoomViewConfig config_;
  DepthRenderer renderer_;
  SensorModel kinect1_{SensorKind::Kinect1};
  SensorModel kinect2_{SensorKind::Kinect2};
  StereoSensor stereo_;
  RenderedView clean_;
  // Of the picture being made.
  Camera sensor_ = Camera::Kinect1;
  TriangleMesh scene_;
  std::vector<Eigen::AlignedBox3d> people_;  // their bounds [m]; the first is who the camera looks at
  Eigen::Isometry3d T_camera_world_ = Eigen::Isometry3d::Identity();
  double back_m_ = 0, left_m_ = 0, right_m_ = 0;  // [m] the room's walls
  std::vector<Eigen::Vector3f> vertices_;
};

}  // namespace depthmocap

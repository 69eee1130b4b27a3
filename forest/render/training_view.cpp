#include "forest/render/training_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "depthmocap/world_frame.h"
#include "forest/render/props.h"
#include "libtracker/body/pose_surface.h"

namespace depthmocap {
namespace {

// Share of the pictures that a Kinect v2 takes (512x424).
constexpr double kKinect2Share = 0.3;
// Share of the pictures that a Kinect v1 takes at 320x240; the rest is 640x480.
constexpr double kHalfSizeShare = 0.5;

Eigen::AlignedBox3d boundsOf(const std::vector<Eigen::Vector3f>& vertices) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& v : vertices) box.extend(v);
  return box.cast<double>();
}

// Where the middle of something `size` [rad] wide goes in a view of `field` [rad]: anywhere that keeps it inside, or,
// where it does not fit, anywhere that keeps the view filled.
double randomOffset(double field, double size, Random& random) {
  const double slack = 0.5 * std::abs(field - size);
  return random.uniform(-slack, slack);
}

// Leaves the actor and what he carries; the latter has no part.
void keepActor(TrainingView& view) {
  for (std::size_t i = 0; i < view.depth.data.size(); ++i) {
    std::uint8_t& part = view.parts.data[i];
    if (part == 0) view.depth.data[i] = 0;
    if (part == kCarried) part = 0;
  }
}

}  // namespace

void TrainingViewRenderer::render(const BodySurface& body, const Pose& q, Random& random, TrainingView& view) {
  drawCamera(random, view);
  placeActor(body, q, random, view);
  renderer_.setBody(vertices_, body.triangles, body.part);
  renderer_.setBackground(drawProps(body.skeleton, view.q_world, random));
  SensorModel& sensor = view.sensor == SensorKind::Kinect1 ? kinect1_ : kinect2_;
  const bool noisy = random.uniform() < config_.noise_share;
  renderer_.render(view.camera, view.T_camera_world, noisy ? sensor.renderOptions() : RenderOptions{}, clean_);
  if (noisy) {
    sensor.apply(clean_, view.camera, random, view.depth, view.parts);
  } else {
    view.depth = clean_.depth;
    view.parts = clean_.parts;
  }
  keepActor(view);
}

// No number is drawn where it decides nothing: the pictures of a seed stay what they are.
TriangleMesh TrainingViewRenderer::drawProps(const Skeleton& skeleton, const Pose& q_world, Random& random) const {
  TriangleMesh props;
  const auto decide = [&](double share) { return share > 0 && random.uniform() < share; };
  if (decide(config_.carried_share)) addCarried(skeleton, q_world, random, props);
  if (decide(config_.obstacle_share)) addObstacle(boundsOf(vertices_), random, props);
  return props;
}

void TrainingViewRenderer::drawCamera(Random& random, TrainingView& view) const {
  const double choice = random.uniform();
  view.sensor = choice < kKinect2Share ? SensorKind::Kinect2 : SensorKind::Kinect1;
  const bool half_size = view.sensor == SensorKind::Kinect1 && choice < kKinect2Share + kHalfSizeShare;
  view.camera = sensorCamera(view.sensor, half_size);
  view.camera.fx *= random.uniform(config_.min_focal_scale, config_.max_focal_scale);
  view.camera.fy = view.camera.fx;
}

void TrainingViewRenderer::placeActor(const BodySurface& body, const Pose& q, Random& random, TrainingView& view) {
  const bool facing = random.uniform() < config_.facing_share;
  const double range = facing ? config_.facing_range : std::numbers::pi;
  view.q_world = q;
  view.q_world[kRootRy] = random.uniform(-range, range);
  view.q_world.head<3>().setZero();
  poseSurface(body, view.q_world, vertices_);

  const Eigen::AlignedBox3d bounds = boundsOf(vertices_);
  const double distance = random.uniform(config_.min_distance_m, config_.max_distance_m);
  const double field = 2.0 * std::atan(0.5 * view.camera.width / view.camera.fx);
  const double width = 2.0 * std::atan(0.5 * (bounds.max().x() - bounds.min().x()) / distance);
  double bearing = randomOffset(field, width, random);
  if (random.uniform() < config_.cut_share) {
    bearing = (random.uniform() < 0.5 ? -0.5 : 0.5) * field * random.uniform(0.7, 1.0);
  }
  const Eigen::Vector3d middle = bounds.center();
  const Eigen::Vector3d root(distance * std::tan(bearing) - middle.x(), -bounds.min().y(), -distance - middle.z());
  view.q_world.head<3>() = root;
  for (Eigen::Vector3f& v : vertices_) v += root.cast<float>();
  aimCamera(distance, random, view);
}

// The camera stands above the world's origin and looks along -z, tilted so that the actor is in view.
void TrainingViewRenderer::aimCamera(double distance_m, Random& random, TrainingView& view) const {
  const Eigen::AlignedBox3d bounds = boundsOf(vertices_);
  const double height = random.uniform(config_.min_camera_height_m, config_.max_camera_height_m);
  const double top = std::atan2(bounds.max().y() - height, distance_m);
  const double bottom = std::atan2(bounds.min().y() - height, distance_m);
  const double field = 2.0 * std::atan(0.5 * view.camera.height / view.camera.fy);
  const double aim = 0.5 * (top + bottom) + randomOffset(field, top - bottom, random);
  const double tilt = std::clamp(aim, -config_.max_tilt, config_.max_tilt);  // up is positive
  const double roll = random.uniform(-config_.max_roll, config_.max_roll);
  const Eigen::Matrix3d R_camera_level =
      (Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-tilt, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  view.T_camera_world.linear() = R_camera_level * uprightWorldFromCamera();
  view.T_camera_world.translation() = -(view.T_camera_world.linear() * Eigen::Vector3d(0.0, height, 0.0));
}

}  // namespace depthmocap

#include "forest/render/room_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "depthmocap/world_frame.h"
#include "forest/render/furniture.h"
#include "forest/render/props.h"
#include "forest/render/room_occupancy.h"
#include "forest/render/shapes.h"
#include "libtracker/body/pose_surface.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

// Parts of the scene's mesh beyond those of people (Part) and what they carry (kCarried).
constexpr std::uint8_t kThing = kCarried + 1;
constexpr std::uint8_t kShell = kCarried + 2;

// Shares of the kinds of pictures, and measures of rooms, are drawn to cover what is met in homes, offices and clinics;
// they were not tuned.
constexpr double kLyingShare = 0.05;     // of the people who lie, whatever their pose
constexpr double kBehindShare = 0.22;    // of the people with something before them
constexpr double kCarryingShare = 0.08;  // of the people who carry something
constexpr double kOutsideShare = 0.06;   // of the pictures without walls
constexpr double kSeatedShare = 0.9;     // of the poses that sit and get a seat
constexpr int kSitterDraws = 40;         // a pose that sits is looked for at most so often
constexpr double kRowShare = 0.35;       // of the pictures of several who stand in a row
constexpr double kCutOutShare = 0.06;    // of the pictures whose room was removed

Eigen::AlignedBox3d boundsOf(const std::vector<Eigen::Vector3f>& vertices) {
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& v : vertices) box.extend(v);
  return box.cast<double>();
}

void append(TriangleMesh& scene, std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), vertices.begin(), vertices.end());
  for (const Triangle& t : triangles) scene.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

void append(TriangleMesh& scene, TriangleMesh piece, const Eigen::Isometry3d& T_world_piece) {
  const Eigen::Isometry3f T = T_world_piece.cast<float>();
  for (Eigen::Vector3f& v : piece.vertices) v = T * v;
  append(scene, piece.vertices, piece.triangles);
  fillParts(scene, kThing);
}

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& end) {
  const double t = std::clamp(p.dot(end) / std::max(1e-9, end.squaredNorm()), 0.0, 1.0);
  return (p - t * end).norm();
}

double radiusOf(const TriangleMesh& piece) {
  float r2 = 0;
  for (const Eigen::Vector3f& v : piece.vertices) r2 = std::max(r2, v.x() * v.x() + v.z() * v.z());
  return std::sqrt(static_cast<double>(r2));
}

double heightOf(const TriangleMesh& piece) {
  float top = 0;
  for (const Eigen::Vector3f& v : piece.vertices) top = std::max(top, v.y());
  return static_cast<double>(top);
}

}  // namespace

void RoomViewRenderer::render(std::span<const BodySurface> bodies, const std::function<Pose(Random&)>& draw,
                              Random& random, RoomView& view) {
  scene_ = {};
  people_.clear();
  drawCamera(random, view);
  placePeople(bodies, draw, random, view);
  addRoom(random);
  addFurniture(random);
  aim(random, view);
  renderer_.setBackground(scene_);
  sense(random, view);
}

// Coarse images of what the cameras deliver: Kinect v1 640x480 at f = 576 px; Kinect v2 512x424, f = 365; RealSense and
// Orbbec 640x480 at f = 385 (whole view of the infrared imagers) to 620 (aligned to colour), 16:9 as well, and on their
// side.
void RoomViewRenderer::drawCamera(Random& random, RoomView& view) {
  const double choice = random.uniform();
  sensor_ = choice < 0.25   ? Camera::Kinect1
            : choice < 0.45 ? Camera::Kinect2
            : choice < 0.85 ? Camera::StereoFilled
                            : Camera::StereoRaw;
  const double width = config_.width;
  CameraModel& camera = view.camera;
  camera = {};
  double focal = 0.9;  // [image widths]
  double shape = 0.75;
  if (sensor_ == Camera::Kinect1) focal = random.uniform(0.8, 0.95);
  if (sensor_ == Camera::Kinect2) {
    focal = random.uniform(0.68, 0.82);
    shape = random.uniform() < 0.5 ? 0.83 : 0.9;
  }
  if (sensor_ == Camera::StereoFilled || sensor_ == Camera::StereoRaw) {
    focal = random.uniform(0.58, 1.0);
    shape = random.uniform() < 0.35 ? 0.5625 : 0.75;
  }
  camera.width = config_.width;
  camera.height = static_cast<int>(std::lround(width * shape));
  camera.fx = camera.fy = focal * width;
  if (random.uniform() < 0.06) std::swap(camera.width, camera.height);  // on its side
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
}

void RoomViewRenderer::placePeople(std::span<const BodySurface> bodies, const std::function<Pose(Random&)>& draw,
                                   Random& random, const RoomView& view) {
  if (random.uniform() < config_.empty_share) return;
  const bool company = random.uniform() < config_.company_share;
  const int count =
      company ? 2 + static_cast<int>(random.below(static_cast<std::uint32_t>(config_.most_people - 1))) : 1;
  std::vector<Eigen::Vector2d> places;
  const bool row = random.uniform() < kRowShare;
  for (int i = 0; i < count; ++i) {
    const double distance = random.uniform(config_.min_distance_m, config_.max_distance_m);
    const double half_field = std::atan(0.5 * view.camera.width / view.camera.fx);
    const double bearing = half_field * random.uniform(-1, 1) * (i == 0 ? 0.8 : 1.1);
    Eigen::Vector2d place(distance * std::tan(bearing), -distance);
    if (row && i > 0) {  // beside the first, to the left and to the right in turn
      const int side = (i % 2 == 0 ? 1 : -1) * ((i + 1) / 2);
      place = places.front() + Eigen::Vector2d(side * random.uniform(0.45, 0.8), random.uniform(-0.4, 0.4));
      place.y() = std::min(place.y(), -config_.min_distance_m);
    }
    const double apart = random.uniform(0.3, 0.7);  // people may touch
    const bool free = std::ranges::none_of(places, [&](const auto& p) { return (p - place).norm() < apart; });
    if (!free) continue;
    places.push_back(place);
    const BodySurface& body = bodies[random.below(static_cast<std::uint32_t>(bodies.size()))];
    Pose q = draw(random);
    if (random.uniform() < config_.sitter_share) {
      for (int k = 0; k < kSitterDraws && !isSeated(body.skeleton, q); ++k) q = draw(random);
    }
    placeActor(body, q, place, random);
  }
}

void RoomViewRenderer::placeActor(const BodySurface& body, Pose q, const Eigen::Vector2d& place, Random& random) {
  q.head<3>().setZero();
  q[kRootRy] =
      random.uniform() < 0.45 ? random.uniform(-1.0, 1.0) : random.uniform(-std::numbers::pi, std::numbers::pi);
  const bool lies = random.uniform() < kLyingShare;
  if (lies) {
    q[kRootRx] = random.uniform() < 0.7 ? -0.5 * std::numbers::pi : 0.5 * std::numbers::pi;
    q[kRootRz] = 0;
  }
  poseSurface(body, q, vertices_);
  const Eigen::AlignedBox3d bounds = boundsOf(vertices_);
  double lift = -bounds.min().y();
  if (lies && random.uniform() < 0.7) lift += random.uniform(0.3, 0.6);  // on a bed
  q.head<3>() = Eigen::Vector3d(place.x(), lift, place.y());
  for (Eigen::Vector3f& v : vertices_) v += q.head<3>().cast<float>();
  append(scene_, vertices_, body.triangles);
  scene_.part.insert(scene_.part.end(), body.part.begin(), body.part.end());
  people_.push_back(boundsOf(vertices_));
  if (lies && people_.back().min().y() > 0.1) {
    append(scene_, drawCouch(people_.back().min().y() + 0.02, random),
           placed(aboutY(q[kRootRy] + 0.5 * std::numbers::pi), {place.x(), 0, place.y()}));
  } else if (!lies) {
    supportActor(body, q, random);
  }
  if (random.uniform() < kCarryingShare) addCarried(body.skeleton, q, random, scene_);
  if (random.uniform() < kBehindShare) {
    addObstacle(people_.back(), random, scene_);
    for (std::uint8_t& part : scene_.part) part = part == 0 ? kThing : part;
  }
}

void RoomViewRenderer::supportActor(const BodySurface& body, const Pose& q, Random& random) {
  if (!isSeated(body.skeleton, q) || random.uniform() > kSeatedShare) return;
  const double pelvis = jointPositions(body.skeleton, q)(1, static_cast<int>(Joint::Pelvis));
  const double seat = pelvis - random.uniform(0.07, 0.11);
  append(scene_, drawSeat(seat, random), placed(aboutY(q[kRootRy] + random.uniform(-0.3, 0.3)), {q[0], 0, q[2]}));
}

void RoomViewRenderer::addRoom(Random& random) {
  double farthest = 1.5;
  double left = 0;
  double right = 0;
  for (const Eigen::AlignedBox3d& person : people_) {
    farthest = std::max(farthest, -person.min().z());
    left = std::min(left, person.min().x());
    right = std::max(right, person.max().x());
  }
  const bool outside = random.uniform() < kOutsideShare;
  const double slack = outside ? 20.0 : 0.0;
  back_m_ = -(farthest + random.uniform(0.02, people_.empty() ? 3.0 : 2.5) + slack);
  left_m_ = left - random.uniform(0.05, 3.0) - slack;
  right_m_ = right + random.uniform(0.05, 3.0) + slack;
  const double front = 1.0;
  const double top = outside ? 30.0 : random.uniform(2.2, 3.2);
  const Eigen::Vector3d a(left_m_, 0, back_m_), b(right_m_, 0, back_m_), c(right_m_, 0, front), d(left_m_, 0, front);
  const Eigen::Vector3d up(0, top, 0);
  addQuad(scene_, {d, c, b, a});
  if (!outside) {
    // Walls lean a little against each other's right angle, as rooms do in a camera that is not level with them.
    addQuad(scene_, {a, b, b + up, a + up});
    addQuad(scene_, {d, a, a + up, d + up});
    addQuad(scene_, {b, c, c + up, b + up});
    addQuad(scene_, {a + up, b + up, c + up, d + up});
  }
  fillParts(scene_, kShell);
}

void RoomViewRenderer::addFurniture(Random& random) {
  const int count = static_cast<int>(random.below(13));
  const double depth = std::min(5.5, -back_m_);
  for (int i = 0; i < count; ++i) {
    TriangleMesh piece = drawFurniture(static_cast<Furniture>(random.below(kFurnitureCount)), random);
    const double radius = radiusOf(piece);
    const double height = heightOf(piece);
    for (int attempt = 0; attempt < 12; ++attempt) {
      const double z = -random.uniform(0.4, depth);
      const double reach = 0.9 * -z + 0.5;  // about the width of view
      const Eigen::Vector2d p(random.uniform(std::max(left_m_, -reach), std::min(right_m_, reach)), z);
      if (p.norm() < radius + 0.25) continue;  // not on the camera
      bool free = true;
      for (const Eigen::AlignedBox3d& person : people_) {
        const Eigen::Vector2d where(person.center().x(), person.center().z());
        const Eigen::Vector2d half(0.5 * person.sizes().x(), 0.5 * person.sizes().z());
        const double near = radius * random.uniform(0.6, 1.0) + std::min(0.35, half.maxCoeff());
        free &= (p - where).norm() > near;
        const bool hides = p.norm() < where.norm() && distanceToSegment(p, where) < radius + 0.1;
        free &= !hides || height < 0.5 || random.uniform() < 0.15;
      }
      if (!free) continue;
      const bool along_wall = random.uniform() < 0.4;
      const double turn = along_wall ? 0.5 * std::numbers::pi * random.below(4) : random.uniform(-3.2, 3.2);
      append(scene_, std::move(piece), placed(aboutY(turn), {p.x(), 0, p.y()}));
      break;
    }
  }
}

// The camera stands above the world's origin and looks along -z, tilted so that the actor is in view.
void RoomViewRenderer::aim(Random& random, const RoomView& view) {
  const double height = random.uniform(config_.min_camera_height_m, config_.max_camera_height_m);
  double aim = random.uniform(-config_.max_tilt, 0.3);
  if (!people_.empty()) {
    const Eigen::AlignedBox3d& actor = people_.front();
    const double distance = std::max(0.3, -actor.center().z());
    const double top = std::atan2(actor.max().y() - height, distance);
    const double bottom = std::atan2(actor.min().y() - height, distance);
    const double field = 2.0 * std::atan(0.5 * view.camera.height / view.camera.fy);
    const double slack = 0.5 * std::abs(field - (top - bottom));
    aim = 0.5 * (top + bottom) + random.uniform(-slack, slack);
    if (top - bottom > field) aim = top - 0.5 * field + random.uniform(-0.15, 0.1);  // heads stay in view
  }
  const double tilt = std::clamp(aim, -config_.max_tilt, config_.max_tilt);  // up is positive
  const double roll = random.uniform() < 0.1 ? random.uniform(-0.25, 0.25) : random.uniform(-0.06, 0.06);
  T_camera_world_.linear() =
      (Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-tilt, Eigen::Vector3d::UnitX()))
          .toRotationMatrix() *
      uprightWorldFromCamera();
  T_camera_world_.translation() = -(T_camera_world_.linear() * Eigen::Vector3d(0.0, height, 0.0));
}

void RoomViewRenderer::sense(Random& random, RoomView& view) {
  if (sensor_ == Camera::StereoFilled || sensor_ == Camera::StereoRaw) {
    StereoNoise& n = stereo_.noise;
    n = {};
    n.baseline_m = random.uniform() < 0.5 ? 0.05 : random.uniform(0.04, 0.095);
    n.disparity_noise_px = random.uniform(0.02, 0.2);
    n.window_px = random.uniform(6, 22);
    n.fattening_px = random.uniform(0, 6);
    const bool filled = sensor_ == Camera::StereoFilled;
    n.filling = filled ? static_cast<HoleFilling>(1 + random.below(3)) : HoleFilling::None;
    n.smoothing_px = random.uniform() < (filled ? 0.8 : 0.4) ? random.uniform(2, 20) : 0;
    n.dropout = random.uniform(0, filled ? 0.15 : 0.3);
    n.dropout_px = random.uniform(12, 60);
    renderer_.render(view.camera, T_camera_world_, stereo_.renderOptions(), clean_);
    stereo_.apply(clean_, view.camera, random, view.depth, view.classes);
  } else {
    SensorModel& sensor = sensor_ == Camera::Kinect1 ? kinect1_ : kinect2_;
    renderer_.render(view.camera, T_camera_world_, sensor.renderOptions(), clean_);
    sensor.apply(clean_, view.camera, random, view.depth, view.classes);
  }
  const bool cut_out = random.uniform() < kCutOutShare;
  for (std::size_t i = 0; i < view.depth.data.size(); ++i) {
    const std::uint8_t part = view.classes.data[i];
    if (view.depth.data[i] > static_cast<float>(config_.max_depth_m)) view.depth.data[i] = 0;
    if (cut_out && (part == 0 || part > kPartCount)) view.depth.data[i] = 0;
    RoomClass what = RoomClass::Unknown;
    if (part >= 1 && part <= kPartCount) what = RoomClass::Person;
    if (part == kThing) what = RoomClass::Thing;
    if (part == kShell) what = RoomClass::Shell;
    view.classes.data[i] = view.depth.data[i] > 0 ? static_cast<std::uint8_t>(what) : 0;
  }
}

}  // namespace depthmocap

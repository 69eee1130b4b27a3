#include "forest/render/scene_view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "depthmocap/world_frame.h"
#include "forest/render/furnished_room.h"
#include "forest/render/furniture.h"
#include "forest/render/person_label.h"
#include "forest/render/shapes.h"
#include "libtracker/body/pose_surface.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr std::array<SceneKind, 7> kOccupied = {SceneKind::Sofa,  SceneKind::Bed,        SceneKind::Chair,
                                                SceneKind::Table, SceneKind::BehindSofa, SceneKind::Cluttered,
                                                SceneKind::Corner};
constexpr double kFacingRange = 1.0;  // [rad]
constexpr double kOnBedShare = 0.7;   // of the people who lie
constexpr double kBetween_m = 0.6;    // least distance of two people, middle to middle
constexpr int kPlaces = 20;           // tries for the second person

// The image of a named camera, its longer side at most `most` pixels, at a focal length near the nominal one.
CameraModel scaledCamera(SensorKind kind, int most, Random& random) {
  CameraModel camera = sensorCamera(kind);
  const double scale = std::min(1.0, static_cast<double>(most) / std::max(camera.width, camera.height));
  camera.width = static_cast<int>(std::lround(camera.width * scale));
  camera.height = static_cast<int>(std::lround(camera.height * scale));
  camera.fx = camera.fy = camera.fx * scale * random.uniform(0.9, 1.1);
  camera.cx = 0.5 * (camera.width - 1);
  camera.cy = 0.5 * (camera.height - 1);
  return camera;
}

void append(const TriangleMesh& piece, const Eigen::Isometry3d& T_world_piece, TriangleMesh& scene) {
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  const Eigen::Isometry3f T = T_world_piece.cast<float>();
  for (const Eigen::Vector3f& v : piece.vertices) scene.vertices.emplace_back(T * v);
  for (const Triangle& t : piece.triangles) scene.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

}  // namespace

void SceneViewRenderer::render(std::span<const BodySurface> bodies, const std::function<Pose(Random&)>& draw,
                               Random& random, SceneView& view) {
  DMC_CHECK(!bodies.empty());
  drawCamera(random, view);
  const double floor_y = -random.uniform(config_.min_camera_height_m, config_.max_camera_height_m);
  Person actor = drawPerson(bodies, draw, random);
  const double distance = random.uniform(config_.min_distance_m, config_.max_distance_m);
  const double half_view = 0.5 * view.camera.width / view.camera.fx;
  const bool on_bed = actor.lies && random.uniform() < kOnBedShare;
  placePerson({distance * half_view * random.uniform(-0.8, 0.8), -distance}, floor_y,
              on_bed ? random.uniform(0.35, 0.6) : 0.0, actor);

  view.scene = random.uniform() < config_.empty_share
                   ? SceneKind::Empty
                   : kOccupied[random.below(static_cast<std::uint32_t>(kOccupied.size()))];
  const bool occupied = view.scene != SceneKind::Empty;
  // Who lies has his bed; the other scenes' pieces are for those who sit and stand.
  if (occupied && actor.lies) view.scene = SceneKind::Corner;
  std::optional<Person> other;
  if (occupied && random.uniform() < config_.other_share) {
    other = drawPerson(bodies, draw, random);
    const double between = random.uniform(kBetween_m, 2.0);
    for (int i = 0; i < kPlaces; ++i) {
      const double angle = random.uniform(-std::numbers::pi, std::numbers::pi);
      const Eigen::Vector2d where(actor.q[kRootTx] + between * std::cos(angle),
                                  actor.q[kRootTz] + between * std::sin(angle));
      if (where.y() > -config_.min_distance_m && i + 1 < kPlaces) continue;
      placePerson({where.x(), std::min(where.y(), -config_.min_distance_m)}, floor_y, 0.0, *other);
      break;
    }
  }

  RoomPeople people;
  people.floor_y = floor_y;
  people.skeleton = &actor.body->skeleton;
  people.distance_m = distance;
  if (occupied) people.actor = {&actor.q, 1};
  if (other) people.others = bodyPoints(other->body->skeleton, {&other->q, 1});
  TriangleMesh scene = makeFurnishedRoom(view.scene, people, random);
  if (occupied && on_bed) {
    append(drawCouch(actor.bounds.min().y() - floor_y + 0.02, random),
           placed(aboutY(actor.q[kRootRy] + 0.5 * std::numbers::pi), {actor.q[kRootTx], floor_y, actor.q[kRootTz]}),
           scene);
  }
  fillParts(scene, 0);
  if (occupied) addPerson(actor, 1, scene);
  if (other) addPerson(*other, 2, scene);
  view.q_world = occupied ? actor.q : Pose(Pose::Zero());
  aimCamera(actor, floor_y, random, view);

  if (sensors_.empty()) {
    for (const NamedCamera& camera : namedCameras()) sensors_.emplace_back(camera.kind);
  }
  SensorModel& sensor = sensors_[static_cast<std::size_t>(view.sensor)];
  renderer_.setBackground(scene);
  renderer_.render(view.camera, view.T_camera_world, sensor.renderOptions(), clean_);
  sensor.apply(clean_, view.camera, random, view.depth, view.classes);
  for (std::uint8_t& label : view.classes.data) label = std::min(label, kOtherPerson);
}

void SceneViewRenderer::drawCamera(Random& random, SceneView& view) const {
  view.sensor = namedCameras()[random.below(static_cast<std::uint32_t>(namedCameras().size()))].kind;
  view.camera = scaledCamera(view.sensor, config_.most_pixels, random);
}

SceneViewRenderer::Person SceneViewRenderer::drawPerson(std::span<const BodySurface> bodies,
                                                        const std::function<Pose(Random&)>& draw, Random& random) {
  Person person;
  person.body = &bodies[random.below(static_cast<std::uint32_t>(bodies.size()))];
  person.q = draw(random);
  person.lies = random.uniform() < config_.lying_share;
  if (person.lies) {
    person.q[kRootRx] = (random.uniform() < 0.7 ? -0.5 : 0.5) * std::numbers::pi;  // on the back, or on the face
    person.q[kRootRz] = 0;
  }
  const bool facing = random.uniform() < config_.facing_share;
  person.q[kRootRy] =
      facing ? random.uniform(-kFacingRange, kFacingRange) : random.uniform(-std::numbers::pi, std::numbers::pi);
  return person;
}

void SceneViewRenderer::placePerson(const Eigen::Vector2d& where, double floor_y, double lift_m, Person& person) {
  person.q.head<3>() = Eigen::Vector3d(where.x(), 0, where.y());
  poseSurface(*person.body, person.q, vertices_);
  Eigen::AlignedBox3f box;
  for (const Eigen::Vector3f& v : vertices_) box.extend(v);
  const double rise = floor_y + lift_m - static_cast<double>(box.min().y());
  person.q[kRootTy] = rise;
  person.bounds = box.cast<double>();
  person.bounds.translate(Eigen::Vector3d(0, rise, 0));
}

void SceneViewRenderer::addPerson(const Person& person, int id, TriangleMesh& scene) {
  poseSurface(*person.body, person.q, vertices_);
  const auto first = static_cast<std::uint32_t>(scene.vertices.size());
  scene.vertices.insert(scene.vertices.end(), vertices_.begin(), vertices_.end());
  for (const Triangle& t : person.body->triangles)
    scene.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  for (const std::uint8_t part : person.body->part) scene.part.push_back(labelOf(part, id));
}

// Tilted so that where the actor is, or would be, is in view.
void SceneViewRenderer::aimCamera(const Person& actor, double floor_y, Random& random, SceneView& view) const {
  const double distance = std::max(0.3, -actor.q[kRootTz]);
  const double top = std::atan2(std::max(actor.bounds.max().y(), floor_y + 0.5), distance);
  const double bottom = std::atan2(floor_y, distance);
  const double field = 2.0 * std::atan(0.5 * view.camera.height / view.camera.fy);
  const double slack = 0.5 * std::abs(field - (top - bottom));
  const double up =
      std::clamp(0.5 * (top + bottom) + random.uniform(-slack, slack), -config_.max_tilt, config_.max_tilt);
  const double roll = random.uniform(-config_.max_roll, config_.max_roll);
  view.T_camera_world = Eigen::Isometry3d::Identity();
  view.T_camera_world.linear() =
      (Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(-up, Eigen::Vector3d::UnitX()))
          .toRotationMatrix() *
      uprightWorldFromCamera();
}

}  // namespace depthmocap

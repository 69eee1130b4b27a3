#include "forest/render/synthesize.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <deque>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "depthmocap/world_frame.h"
#include "forest/render/furnished_room.h"
#include "forest/render/person_label.h"
#include "forest/render/room_occupancy.h"
#include "forest/render/scene.h"
#include "libtracker/body/pose_surface.h"
#include "libtracker/core/parallel.h"
#include "libtracker/recording/png_file.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/track_files.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

// Of the seed's streams, which rooms are drawn from; those of frames count from 0.
constexpr std::uint64_t kRoomStream = 1ULL << 40U;
constexpr std::size_t kFramesAWorker = 4;  // rendered before the writer takes over; bounds the memory

struct RenderedFrame {
  DepthFrame depth;
  PartImage parts;
};

Eigen::Matrix3d tiltedCameraFromWorld(const SynthesisConfig& config) {
  return Eigen::AngleAxisd(config.camera_tilt, Eigen::Vector3d::UnitX()).toRotationMatrix() * uprightWorldFromCamera();
}

using PosesOfEach = std::vector<std::vector<Pose>>;

// What stands and moves around the actor.
class Surroundings {
 public:
  Surroundings(TriangleMesh room, const SynthesisConfig& config, const PosesOfEach& poses)
      : mesh_(std::move(room)), room_vertices_(mesh_.vertices.size()), others_(config.others), poses_(poses) {
    if (!others_.empty()) mesh_.part.resize(mesh_.triangles.size(), 0);
    auto first = static_cast<std::uint32_t>(room_vertices_);
    for (std::size_t k = 0; k < others_.size(); ++k) {
      const BodySurface& body = others_[k].body;
      for (const Triangle& t : body.triangles) mesh_.triangles.push_back({first + t[0], first + t[1], first + t[2]});
      for (const std::uint8_t part : body.part) mesh_.part.push_back(labelOf(part, personOf(k)));
      first += static_cast<std::uint32_t>(body.vertices.size());
    }
  }
  static int personOf(std::size_t other) { return static_cast<int>(other) + 2; }

  // Valid until the next call.
  const TriangleMesh& at(std::size_t frame) {
    mesh_.vertices.resize(room_vertices_);
    for (std::size_t k = 0; k < others_.size(); ++k) {
      poseSurface(others_[k].body, poses_[k][std::min(frame, poses_[k].size() - 1)], vertices_);
      mesh_.vertices.insert(mesh_.vertices.end(), vertices_.begin(), vertices_.end());
    }
    return mesh_;
  }

 private:
  TriangleMesh mesh_;
  std::size_t room_vertices_;
  const std::vector<OtherPerson>& others_;
  const PosesOfEach& poses_;
  std::vector<Eigen::Vector3f> vertices_;
};

// What one thread needs to render frames.
class FrameRenderer {
 public:
  FrameRenderer(const BodySurface& body, const SynthesisConfig& config, Surroundings surroundings)
      : body_(body), config_(config), sensor_(config.sensor), surroundings_(std::move(surroundings)) {
    T_camera_world_.linear() = tiltedCameraFromWorld(config);
  }

  void render(const Pose& q, RenderedFrame& frame) {
    renderer_.setBackground(surroundings_.at(static_cast<std::size_t>(frame.depth.frame)));
    if (config_.scene != SceneKind::Empty) {
      poseSurface(body_, q, vertices_);
      renderer_.setBody(vertices_, body_.triangles, body_.part);
    }
    renderer_.render(config_.camera, T_camera_world_, config_.noise ? sensor_.renderOptions() : RenderOptions{},
                     clean_);
    if (config_.noise) {
      Random random(config_.seed, static_cast<std::uint64_t>(frame.depth.frame));
      sensor_.apply(clean_, config_.camera, random, frame.depth.depth, frame.parts);
    } else {
      frame.depth.depth = clean_.depth;
      frame.parts = clean_.parts;
    }
  }

 private:
  const BodySurface& body_;
  const SynthesisConfig& config_;
  Eigen::Isometry3d T_camera_world_ = Eigen::Isometry3d::Identity();
  DepthRenderer renderer_;
  SensorModel sensor_;
  Surroundings surroundings_;
  RenderedView clean_;
  std::vector<Eigen::Vector3f> vertices_;
};

JointsRow truthRow(const Skeleton& skeleton, const Pose& q, const SynthesisConfig& config, const DepthFrame& frame) {
  const CameraModel& camera = config.camera;
  JointsRow row;
  row.frame = frame.frame;
  row.time_s = frame.time_s;
  row.state = TrackState::Tracking;
  row.p_camera = tiltedCameraFromWorld(config) * jointPositions(skeleton, q);
  for (int j = 0; j < kJointCount; ++j) {
    const Eigen::Vector3d p = row.p_camera.col(j);
    if (p.z() <= 0) continue;
    const Eigen::Vector2d uv = camera.project(p);
    const bool inside = uv.x() >= 0 && uv.y() >= 0 && uv.x() <= camera.width - 1 && uv.y() <= camera.height - 1;
    row.confidence[j] = inside ? 1.0 : 0.0;
  }
  return row;
}

TriangleMesh sceneFor(const SynthesisConfig& config, const BodySurface& body, const StagedMotion& staged,
                      const PosesOfEach& others) {
  if (config.scene == SceneKind::None) return {};
  if (config.scene == SceneKind::Room) {
    std::vector<Eigen::Vector3d> path;
    for (const Pose& q : staged.poses) path.emplace_back(q.head<3>());
    for (const std::vector<Pose>& poses : others) {
      for (const Pose& q : poses) path.emplace_back(q.head<3>());
    }
    return makeRoom(staged.floor_y, path, config.seed);
  }
  RoomPeople people;
  people.floor_y = staged.floor_y;
  people.skeleton = &body.skeleton;
  people.distance_m = config.staging.distance_m;
  if (config.scene != SceneKind::Empty) people.actor = staged.poses;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const std::vector<Eigen::Vector3d> points = bodyPoints(config.others[k].body.skeleton, others[k]);
    people.others.insert(people.others.end(), points.begin(), points.end());
  }
  Random random(config.seed, kRoomStream);
  return makeFurnishedRoom(config.scene, people, random);
}

void makeLabelFolder(const fs::path& folder) {
  std::error_code failure;
  fs::create_directories(folder, failure);
  if (failure) throw Error("cannot be created: " + failure.message(), folder.string());
}

RecordingInfo infoOf(const SynthesisConfig& config, double fps, double path_scale) {
  RecordingInfo info;
  info.camera = config.camera;
  info.fps = fps;
  info.camera_name = sensorName(config.sensor);
  info.note = config.note;
  if (path_scale < 1) info.note += fmt::format(", path shortened to {:.0f} %", 100 * path_scale);
  return info;
}

// The truth of one person: joints and poses.
class TruthFiles {
 public:
  TruthFiles(const fs::path& folder, const std::string& suffix, const Skeleton& skeleton, const SynthesisConfig& config)
      : joints_(folder / ("joints" + suffix + ".csv")),
        poses_(folder / ("pose" + suffix + ".csv")),
        skeleton_(skeleton),
        config_(config) {}

  void write(const Pose& q, const DepthFrame& frame) {
    joints_.write(truthRow(skeleton_, q, config_, frame));
    poses_.write({frame.frame, frame.time_s, q, tiltedCameraFromWorld(config_).transpose()});
  }
  void writeNobody(const DepthFrame& frame) {
    JointsRow row;
    row.frame = frame.frame;
    row.time_s = frame.time_s;
    joints_.write(row);
  }
  void finish() {
    joints_.finish();
    poses_.finish();
  }

 private:
  JointsWriter joints_;
  PoseWriter poses_;
  const Skeleton& skeleton_;
  const SynthesisConfig& config_;
};

}  // namespace

void synthesizeRecording(const MotionClip& clip, const BodySurface& body, const SynthesisConfig& config,
                         const fs::path& folder, const std::function<void(std::size_t)>& progress) {
  if (config.others.size() > kMostOthers) {
    throw Error(fmt::format("{} other people; at most {} are rendered", config.others.size(), kMostOthers),
                folder.string());
  }
  const StagedMotion staged = stageMotion(clip, body, config.staging);
  PosesOfEach others;
  for (const OtherPerson& other : config.others) others.push_back(stageOther(other, staged));
  const Surroundings surroundings(sceneFor(config, body, staged, others), config, others);
  RecordingWriter recording(folder, infoOf(config, clip.fps, staged.path_scale),
                            RecordingWriter::Appears::WhenFinished);
  const fs::path truth_folder = recording.folder() / "truth";
  const fs::path labels = truth_folder / "labels";
  makeLabelFolder(labels);
  TruthFiles truth(truth_folder, "", body.skeleton, config);
  std::deque<TruthFiles> truth_of_others;
  for (std::size_t k = 0; k < others.size(); ++k) {
    const std::string suffix = fmt::format("-{}", Surroundings::personOf(k));
    truth_of_others.emplace_back(truth_folder, suffix, config.others[k].body.skeleton, config);
  }

  const auto workers = static_cast<std::size_t>(config.threads);
  std::vector<FrameRenderer> renderers;
  for (std::size_t w = 0; w < workers; ++w) renderers.emplace_back(body, config, surroundings);
  std::vector<RenderedFrame> batch(workers * kFramesAWorker);

  const std::size_t count = staged.poses.size();
  for (std::size_t first = 0; first < count; first += batch.size()) {
    const std::size_t here = std::min(batch.size(), count - first);
    parallelFor(config.threads, workers, [&](std::size_t w) {
      for (std::size_t slot = w; slot < here; slot += workers) {
        RenderedFrame& frame = batch[slot];
        frame.depth.frame = static_cast<std::int64_t>(first + slot);
        frame.depth.time_s = static_cast<double>(first + slot) / clip.fps;
        renderers[w].render(staged.poses[first + slot], frame);
        writePng8(labels / fmt::format("{:06d}.png", frame.depth.frame), frame.parts);
      }
    });
    for (std::size_t slot = 0; slot < here; ++slot) {
      const DepthFrame& frame = batch[slot].depth;
      recording.write(frame);
      if (config.scene == SceneKind::Empty) {
        truth.writeNobody(frame);
      } else {
        truth.write(staged.poses[first + slot], frame);
      }
      for (std::size_t k = 0; k < others.size(); ++k) {
        truth_of_others[k].write(others[k][std::min(first + slot, others[k].size() - 1)], frame);
      }
    }
    if (progress) progress(first + here);
  }
  truth.finish();
  for (TruthFiles& files : truth_of_others) files.finish();
  recording.finish();
}

}  // namespace depthmocap

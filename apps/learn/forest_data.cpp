#include "apps/learn/forest_data.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "forest/train/room_image_source.h"
#include "libtracker/choreography/procedural_motions.h"
#include "libtracker/posedb/pose_database.h"

namespace depthmocap {
namespace {

constexpr std::uint64_t kValidationSeed = 1'000'000;  // added to the seed: bodies and views that training never sees
constexpr double kThinning = 0.10;                    // [rad] poses of a motion that differ less are one pose

PosePool makePosePool(const DataOptions& data, PoseUse use) {
  PosePool pool;
  if (data.t_pose) return pool;
  const HeldOutMotions held_out(data.exclude);
  for (const std::string& file : data.pose_databases) {
    addPoses(loadPoseDatabase(file), held_out, use, kThinning, pool);
  }
  if (data.procedural || data.pose_databases.empty()) {
    addPoses(proceduralMotions(data.seed), held_out, use, kThinning, pool);
  }
  return pool;
}

// People as they usually stand before a camera: captured poses as they are, whole in view, at 1.5 to 4 m, the camera
// about level; every yaw is equally likely.
void askForPlainViews(TrainingViewConfig& view) {
  view.facing_share = 0;
  view.min_distance_m = 1.5;
  view.max_distance_m = 4.0;
  view.min_camera_height_m = 0.8;
  view.max_camera_height_m = 1.6;
  view.max_tilt = 0.2;
  view.cut_share = 0;
  view.carried_share = 0;
  view.obstacle_share = 0;
}

using ImageMaker = std::function<std::unique_ptr<TrainingImageSource>(std::size_t count)>;

TrainingViewConfig viewOf(const DataOptions& data) {
  TrainingViewConfig view;
  view.facing_share = 0.3;  // half of all views are then within 60 degrees of the camera
  if (data.plain) askForPlainViews(view);
  if (data.carried_share) view.carried_share = *data.carried_share;
  if (data.obstacle_share) view.obstacle_share = *data.obstacle_share;
  return view;
}

ImageMaker personImages(const DataOptions& data, std::uint64_t seed, const ImageSet& set) {
  RenderedImageOptions options;
  options.seed = seed;
  options.t_poses = data.t_pose;
  options.view = set.view;
  if (data.plain) options.variation = {.mix_share = 0, .hang_share = 0, .jitter = 0};
  options.variation.posture_share = data.posture_share;
  return [options, bodies = set.bodies, poses = set.poses](std::size_t count) mutable {
    options.count = count;
    return std::make_unique<RenderedImageSource>(bodies, poses, options);
  };
}

ImageMaker roomImages(const DataOptions& data, std::uint64_t seed, const ImageSet& set) {
  RoomImageOptions options;
  options.seed = seed;
  options.view.sitter_share = data.sitter_share;
  options.variation.posture_share = data.posture_share;
  return [options, bodies = set.bodies, poses = set.poses](std::size_t count) mutable {
    options.count = count;
    return std::make_unique<RoomImageSource>(bodies, poses, options);
  };
}

}  // namespace

void addDataOptions(CLI::App& command, DataOptions& data) {
  command.add_option("--posedb", data.pose_databases, "Pose databases to take poses from")->check(CLI::ExistingFile);
  command.add_flag("--procedural", data.procedural,
                   "Take poses from the procedural motions (default without --posedb)");
  command.add_option("--makehuman", data.makehuman, "Folder of the MakeHuman base mesh: half of the bodies are its")
      ->check(CLI::ExistingDirectory);
  command.add_flag("--tpose", data.t_pose, "T-poses facing the camera: the forest of the actor calibration");
  command.add_flag("--plain", data.plain,
                   "People as they usually stand before a camera, not as hard as what forests should learn from");
  command
      .add_option(
          "--posture-share", data.posture_share,
          "Share of the images whose pose is of a posture chosen uniformly: bent and crouching as often as standing")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command
      .add_option("--carried-share", data.carried_share,
                  "Share of the images with a bag or something in a hand (default: 0.12, with --plain 0)")
      ->check(CLI::Range(0.0, 1.0));
  command
      .add_option("--obstacle-share", data.obstacle_share,
                  "Share of the images with something between actor and camera (default: 0.12, with --plain 0)")
      ->check(CLI::Range(0.0, 1.0));
  command.add_option("--exclude", data.exclude,
                     "Motions to hold out for measuring (default: a tenth of all motions, chosen by name)");
  command.add_option("--bodies", data.bodies, "Bodies to render")->check(CLI::Range(1, 10000))->capture_default_str();
  command.add_option("--seed", data.seed, "Of everything random")->capture_default_str();
  command.add_option("--threads", data.threads)->check(CLI::Range(1, 256))->capture_default_str();
}

void readsData(OutputCheck& check, const DataOptions& data) {
  for (const std::string& file : data.pose_databases) check.reads(file);
}

ImageSet makeImageSet(const DataOptions& data, PoseUse use, std::size_t images) {
  const bool train = use == PoseUse::Train;
  const std::uint64_t seed = data.seed + (train ? 0 : kValidationSeed);
  ImageSet set;
  const BodyPoolOptions bodies{train ? data.bodies : std::max(1, data.bodies / 5), data.makehuman, seed};
  set.bodies = std::make_shared<const std::vector<BodySurface>>(makeBodyPool(bodies, data.threads));
  set.poses = std::make_shared<const PosePool>(makePosePool(data, use));
  set.view = viewOf(data);
  set.first = data.rooms ? roomImages(data, seed, set) : personImages(data, seed, set);
  set.source = set.first(images);
  return set;
}

}  // namespace depthmocap

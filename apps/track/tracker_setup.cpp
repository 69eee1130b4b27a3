#include "apps/track/tracker_setup.h"

#include <cstdint>

#include "calibration/calibrated_actor.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/body/sample_surface.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/core/shipped_files.h"
#include "libtracker/tracker/leave_out.h"

namespace depthmocap {
namespace {

constexpr int kSurfacePoints = 1500;  // for the tracker's dense term
constexpr std::uint64_t kSurfaceSeed = 1;

CalibratedActor actorAsSeen(const TrackOptions& options) {
  const CalibratedActor actor = readActorFile(options.actor);
  return scaledActor(actor, 1.0 / actor.depth_scale);
}

}  // namespace

std::shared_ptr<const TrackerModels> loadTrackerModels(const TrackOptions& options) {
  const auto models = std::make_shared<TrackerModels>();
  models->forest = loadForest(options.forest.empty() ? shippedFile("general.forest") : options.forest);
  models->database = loadPoseDatabase(options.posedb.empty() ? shippedFile("default.posedb") : options.posedb);
  models->surface = options.actor.empty() ? sampleSurface(makeBuiltinBody(BodyShape{}), kSurfacePoints, kSurfaceSeed)
                                          : actorSurface(actorAsSeen(options), kSurfacePoints);
  return models;
}

std::optional<ActorModel> actorOf(const TrackOptions& options) {
  if (options.actor.empty()) return std::nullopt;
  return actorAsSeen(options).model;
}

TrackerConfig trackerConfig(const TrackOptions& options) {
  TrackerConfig config = options.method == "paper" ? paperConfig() : TrackerConfig{};
  for (const std::string& part : options.without) leaveOut(part, config);
  config.threads = options.threads;
  if (options.assumed_stature_m > 0) config.policy.assumed_stature_m = options.assumed_stature_m;
  return config;
}

}  // namespace depthmocap

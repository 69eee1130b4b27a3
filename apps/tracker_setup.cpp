#include "apps/tracker_setup.h"

#include <cstdint>

#include "apps/shipped_files.h"
#include "libtracker/body/builtin_body.h"
#include "libtracker/body/sample_surface.h"

namespace depthmocap {
namespace {

constexpr int kSurfacePoints = 1500;  // of the average body, for the tracker's dense term
constexpr std::uint64_t kSurfaceSeed = 1;

}  // namespace

std::shared_ptr<const TrackerModels> loadTrackerModels(const TrackOptions& options) {
  const auto models = std::make_shared<TrackerModels>();
  models->forest = loadForest(options.forest.empty() ? shippedFile("general.forest") : options.forest);
  models->database = loadPoseDatabase(options.posedb.empty() ? shippedFile("default.posedb") : options.posedb);
  models->surface = sampleSurface(makeBuiltinBody(BodyShape{}), kSurfacePoints, kSurfaceSeed);
  return models;
}

TrackerConfig trackerConfig(const TrackOptions& options) {
  TrackerConfig config = options.method == "paper" ? paperConfig() : TrackerConfig{};
  config.threads = options.threads;
  if (options.assumed_stature_m > 0) config.policy.assumed_stature_m = options.assumed_stature_m;
  return config;
}

}  // namespace depthmocap

#include "apps/track/tracker_setup.h"

#include <string>

#include "libtracker/tracker/config_file.h"
#include "libtracker/tracker/leave_out.h"

namespace depthmocap {

Models loadModels(const TrackOptions& options) {
  return Models::load(options.forest, options.posedb);
}

std::optional<Actor> actorOf(const TrackOptions& options) {
  if (options.actor.empty()) return std::nullopt;
  return asSeen(readActorFile(options.actor));
}

TrackerConfig trackerConfig(const TrackOptions& options) {
  TrackerConfig config = options.method == "paper" ? paperConfig() : TrackerConfig{};
  for (const std::string& part : options.without) leaveOut(part, config);
  if (!options.config.empty()) readConfigFile(options.config, config);
  config.threads = options.threads;
  config.people = options.people;
  if (options.assumed_stature_m > 0) config.policy.assumed_stature_m = options.assumed_stature_m;
  if (!options.save_config.empty()) writeConfigFile(options.save_config, config);
  return config;
}

}  // namespace depthmocap

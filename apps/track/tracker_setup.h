#pragma once
#include <memory>
#include <optional>

#include "apps/track/track_options.h"
#include "libtracker/tracker/tracker.h"

namespace depthmocap {

// What a tracker needs, as the options ask: the forest, the pose database (those that come with the build unless others
// are named) and the surface of the calibrated actor or of the average body. Error where a file is missing or damaged.
std::shared_ptr<const TrackerModels> loadTrackerModels(const TrackOptions& options);

// The calibrated body of --actor, as large as the camera sees it; nothing without that option.
std::optional<ActorModel> actorOf(const TrackOptions& options);

TrackerConfig trackerConfig(const TrackOptions& options);

}  // namespace depthmocap

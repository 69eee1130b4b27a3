#pragma once
#include <memory>
#include <optional>

#include "apps/track/track_options.h"
#include "depthmocap/tracker.h"
#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {

// What a tracker needs, as the options ask: the forest and the pose database, those that come with the build unless
// others are named. Error where a file is missing or damaged.
Models loadModels(const TrackOptions& options);

// The calibrated body of --actor, as large as the camera sees it; nothing without that option.
std::optional<Actor> actorOf(const TrackOptions& options);

TrackerConfig trackerConfig(const TrackOptions& options);

}  // namespace depthmocap

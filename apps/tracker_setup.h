#pragma once
#include <memory>

#include "apps/track_options.h"
#include "libtracker/tracker/tracker.h"

namespace depthmocap {

// What a tracker needs, as the options ask: the forest, the pose database (those that come with the build unless others
// are named) and the average body's surface. Error where a file is missing or damaged.
std::shared_ptr<const TrackerModels> loadTrackerModels(const TrackOptions& options);

TrackerConfig trackerConfig(const TrackOptions& options);

}  // namespace depthmocap

#pragma once
#include <filesystem>
#include <memory>

#include "apps/terminal/correction_options.h"
#include "apps/track/track_options.h"
#include "apps/track/track_outputs.h"
#include "depthmocap/tracker.h"
#include "libtracker/recording/recording.h"
#include "libtracker/session/replay_session.h"
#include "libtracker/tracker/tracker_config.h"

namespace depthmocap {

// What to track and how, as the options of `replay` say.
struct ReplayOptions {
  std::filesystem::path recording;
  CorrectionChoice correction;
  TrackOptions track;
  ReplaySessionOptions session;
};

// What tracking one recording needs, in the order in which it has to come up. The options and models outlive it.
struct RecordingRun {
  RecordingRun(const ReplayOptions& options, const Models& models, const RecordingCorrection& correction);

  std::unique_ptr<RecordingReader> reader;
  TrackerConfig config;
  Tracker tracker;
  ReplaySession session;
  TrackOutputs outputs;
};

}  // namespace depthmocap

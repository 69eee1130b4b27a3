#include "apps/track/recording_run.h"

#include "apps/track/tracker_setup.h"

namespace depthmocap {
namespace {

ReplaySessionOptions sessionOptions(const ReplayOptions& options) {
  ReplaySessionOptions session = options.session;
  session.smooth = options.track.smooth;
  session.name = options.recording.string();
  return session;
}

}  // namespace

RecordingRun::RecordingRun(const ReplayOptions& options, const Models& models, const RecordingCorrection& correction)
    : reader(openRecording(options.recording, correction)),
      config(trackerConfig(options.track)),
      tracker(models, reader->info().camera, config, actorOf(options.track)),
      session(*reader, tracker, sessionOptions(options)),
      outputs(options.track, reader->info()) {}

}  // namespace depthmocap

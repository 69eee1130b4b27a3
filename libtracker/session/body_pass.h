#pragma once
#include "libtracker/session/replay_session.h"

namespace depthmocap {

// Tracks the first seconds of what the options choose of a recording, so that its people have from the first frame of
// the next run on the bodies that were fitted over these seconds.
void fitBodies(RecordingReader& reader, Tracker& tracker, ReplaySessionOptions options, const ReplayHooks& hooks);

}  // namespace depthmocap

#include "apps/track/camera_watch.h"

#include <fmt/format.h>

namespace depthmocap {

void CameraWatch::report(const CaptureStatus& now, StatusLine& line) {
  if (seen_.connected && !now.connected) line.note("warning: " + now.problem + "; waiting for the camera to come back");
  if (now.returns > seen_.returns) line.note("the camera is back");
  if (seen_.damaged == 0 && now.damaged > 0) {
    line.note("warning: " + now.problem + "; such frames are counted and left out");
  }
  seen_ = now;
}

void CameraWatch::report(const RecorderStatus& now, StatusLine& line) {
  if (!now.failure.empty() && recorded_.failure.empty()) {
    line.note("warning: " + now.failure + "; recording has ended");
  } else if (now.failure.empty() && now.dropped > 0 && recorded_.dropped == 0) {
    line.note("warning: the disk is too slow, frames are missing from the recording; they are counted");
  }
  recorded_ = now;
}

}  // namespace depthmocap

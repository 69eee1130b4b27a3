#pragma once
#include "apps/terminal/status_line.h"
#include "libtracker/sensor/capture.h"
#include "libtracker/sensor/recorder.h"

namespace depthmocap {

// Tells, once each, what happens to a camera and a recording while they run: lost, found again, damaged, dropped.
class CameraWatch {
 public:
  void report(const CaptureStatus& now, StatusLine& line);
  void report(const RecorderStatus& now, StatusLine& line);

 private:
  CaptureStatus seen_;
  RecorderStatus recorded_;
};

}  // namespace depthmocap

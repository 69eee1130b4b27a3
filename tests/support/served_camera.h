#pragma once
#include <cstdlib>
#include <string>

#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {

// A camera of the OpenNI2 runtime that serves pattern frames in a loop, with faults (tests/drivers). The driver looks
// when the runtime starts. One object at a time.
class ServedCamera {
 public:
  ServedCamera(const RecordingInfo& info, int frames, const std::string& faults = {}) {
    makeRecording(folder_ / "rec", info, frames);
    serve(folder_ / "rec", faults);
  }
  // Serves a recording that is there.
  explicit ServedCamera(const std::filesystem::path& recording) { serve(recording, ""); }
  ~ServedCamera() {
    unsetenv("DEPTHMOCAP_TEST_RECORDING");
    unsetenv("DEPTHMOCAP_TEST_FAULTS");
  }
  ServedCamera(const ServedCamera&) = delete;
  ServedCamera& operator=(const ServedCamera&) = delete;

 private:
  static void serve(const std::filesystem::path& recording, const std::string& faults) {
    setenv("DEPTHMOCAP_TEST_RECORDING", recording.c_str(), 1);
    setenv("DEPTHMOCAP_TEST_FAULTS", faults.c_str(), 1);
  }

  TemporaryFolder folder_;
};

}  // namespace depthmocap

#pragma once

namespace depthmocap {

// Turns Ctrl-C (SIGINT), SIGTERM and, unless it is ignored, SIGHUP of a terminal that closes into a request to stop, so
// that outputs are completed. The second Ctrl-C ends the program at once. One object at a time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();  // signals do again what they did before
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
  [[nodiscard]] static bool made();
};

}  // namespace depthmocap

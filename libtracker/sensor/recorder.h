#pragma once
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "libtracker/sensor/depth_source.h"

namespace depthmocap {

struct RecorderStatus {
  std::int64_t written = 0;
  std::int64_t dropped = 0;  // the disk was too slow, or writing had failed
  std::string failure;       // why writing ended early; empty: it did not
};

// Writes frames to a recording folder on a thread of its own. Never holds up the capture: frames wait in a queue of one
// second, and one that finds it full is dropped, counted, and leaves a gap in the recording's frame numbers. At the
// end, recording.json says how many are missing. The folder appears with the first frame; whatever ends the program, it
// can be read up to what waited.
class Recorder {
 public:
  // Refuses to overwrite a recording. `wait_when_full`: for sources that wait, so that nothing need be dropped.
  // `queue_frames` = 0: one second of the source's frames.
  Recorder(std::filesystem::path folder, const RecordingInfo& info, bool wait_when_full, std::size_t queue_frames = 0);
  ~Recorder();  // writes what waits, keeps silent about failures
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  // Copies the frame into the queue. False: it is dropped.
  bool push(const SensorFrame& frame);
  // Writes what waits and completes recording.json; `missing`: frames that the camera lost, to be noted there. Throws
  // the Error that ended the writing early.
  void finish(std::int64_t missing);
  [[nodiscard]] RecorderStatus status() const;
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

 private:
  void run();
  void writeQueued(RecordingWriter& writer);
  void join();
  void noteWhatIsMissing(std::int64_t missing) const;

  std::filesystem::path folder_;
  RecordingInfo info_;
  bool wait_when_full_;
  std::size_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<DepthFrame> queue_;
  std::vector<DepthFrame> free_;  // memory of frames that are written
  bool finishing_ = false;
  RecorderStatus status_;
  std::exception_ptr failure_;
  std::unique_ptr<RecordingWriter> writer_;
  std::thread thread_;  // last: it uses all others
};

}  // namespace depthmocap

#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "depthmocap/camera_correction.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"

namespace depthmocap {

// What recording.json says. Frames are handed out undistorted and in metres.
struct RecordingInfo {
  CameraModel camera;
  double fps = 30.0;            // [1/s] (> 0)
  double depth_unit_m = 0.001;  // [m] per stored step (> 0)
  std::string camera_name;      // "kinect1", "kinect2", ...
  std::string note;
  std::string extra_json = "{}";  // unknown keys, kept when the recording is rewritten
  // What the recording does not say and was guessed, or is wrong and was passed over: a line each, for people.
  std::vector<std::string> guesses;
};

// A recording that is read frame by frame: depthmocap folder, TUM RGB-D folder or OpenNI file. Not thread-safe.
class RecordingReader {
 public:
  virtual ~RecordingReader() = default;
  [[nodiscard]] virtual const RecordingInfo& info() const = 0;
  [[nodiscard]] virtual std::size_t frameCount() const = 0;
  // Reads frame i in [0, frameCount()) into `frame`, reusing its memory. A file that cannot be read or does not fit the
  // recording (missing, truncated, 8-bit, wrong size) throws Error naming the file and the reason.
  // The frame's own number and time are then not given; the other frames can still be read.
  virtual void read(std::size_t i, DepthFrame& frame) = 0;
  // Number and time of frame i without reading its picture.
  [[nodiscard]] virtual std::int64_t frameNumber(std::size_t i) const = 0;
  [[nodiscard]] virtual double time(std::size_t i) const = 0;  // [s]
  // Reads on as if the recording said this of its camera: intrinsics and distortion, for pictures of the size that they
  // have, and the depth step.
  virtual void believe(const CameraModel& camera, double depth_unit_m) = 0;
  // The pictures' files; empty where they do not have their own.
  [[nodiscard]] virtual std::vector<std::filesystem::path> files() const { return {}; }
};

// What somebody knows better than a recording.
struct RecordingCorrection {
  std::optional<RecordingInfo> camera;  // intrinsics, distortion and depth step; none: the recording's own
  std::optional<double> depth_unit_m;   // [m] (> 0) a stored step, also before the camera's; none: that
  int turn_deg = 0;                     // (0, 90, 180, 270) clockwise, that makes the pictures upright
  void validate() const;                // throws Error naming field, value and rule
};

// [m] Depth steps of cameras are 0.1, 0.125, 0.2, 0.25, 1 and 10 mm; farther out it is a mistake.
inline constexpr double kFinestUnit_m = 1e-6;
inline constexpr double kCoarsestUnit_m = 0.1;

// What `correction` says, its camera read from its file. Throws Error for a file that cannot be read, a depth unit or a
// turn that is not fit.
RecordingCorrection readCorrection(const CameraCorrection& correction);

// Whether openRecording() is worth trying, by the names that are there.
bool looksLikeRecording(const std::filesystem::path& path);

// Opens a recording and checks its header and index; throws Error (missing folder, bad JSON, intrinsics that are NaN,
// zero or negative, no frame at all, times out of order; a correction whose camera takes pictures of another size).
// Pictures are opened one by one, in read().
std::unique_ptr<RecordingReader> openRecording(const std::filesystem::path& path,
                                               const RecordingCorrection& correction = {});

// Writes a recording folder; refuses to overwrite one. Each PNG is written whole or not at all; frames.csv grows with
// each frame, so that a recording cut short is readable up to its last frame. Frames are undistorted, so the camera's
// distortion is not written. Frame numbers and times must grow; a frame that does not follow, and every failure of the
// file system, throws Error.
class RecordingWriter {
 public:
  // Until its first frame is written, or until finish(), the folder's name ends in ".partial", so that whatever ends
  // the program, what has the recording's name can be opened. What has not appeared is removed at the end; what a
  // program left that was killed, by the next writer of the same name.
  enum class Appears { WithFirstFrame, WhenFinished };
  RecordingWriter(const std::filesystem::path& path, const RecordingInfo& info,
                  Appears appears = Appears::WithFirstFrame);
  ~RecordingWriter();
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  // Depth is rounded to info.depth_unit_m; farther than 65535 units becomes 0.
  void write(const DepthFrame& frame);
  // Where the recording is now, for what else belongs into it.
  [[nodiscard]] const std::filesystem::path& folder() const;
  // All is on the disk; nothing may follow.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap

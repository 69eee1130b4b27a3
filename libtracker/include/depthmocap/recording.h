#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "depthmocap/camera_correction.h"
#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/export.h"

namespace depthmocap {

class RecordingReader;

// A recording of a depth camera, read frame by frame in any order. Not thread-safe; several may be open at once, also
// of the same files.
class DEPTHMOCAP_API Recording {
 public:
  // Opens a depthmocap folder, a TUM RGB-D folder or an OpenNI .oni file (docs/reference/formats.md) and checks its
  // header and index; pictures are opened in read(). Throws Error naming the file and what is wrong with it, and for a
  // correction that is not fit.
  explicit Recording(const std::filesystem::path& path, const CameraCorrection& correction = {});
  ~Recording();
  Recording(Recording&& other) noexcept;
  Recording& operator=(Recording&& other) noexcept;

  // The camera of the frames, whose distortion has been taken out. Constant.
  [[nodiscard]] const CameraModel& camera() const;
  // Nominal frame rate [1/s] (> 0). Times of frames are their own.
  [[nodiscard]] double fps() const;
  // The camera's name as the recording holds it, "kinect1" for example; may be empty.
  [[nodiscard]] const std::string& cameraName() const;
  // Frames (>= 1).
  [[nodiscard]] std::size_t frameCount() const;
  // Number and time [s] of frame i (0 .. frameCount() - 1); both grow from frame to frame. Throw Error for another i.
  [[nodiscard]] std::int64_t frameNumber(std::size_t i) const;
  [[nodiscard]] double time_s(std::size_t i) const;

  // Reads frame i (0 .. frameCount() - 1): depth [m], undistorted, 0 = no measurement, of the camera's size. The second
  // form reuses the memory of `frame`. Throws Error for another i and for a picture that is missing, damaged or of
  // another size; the other frames can still be read.
  [[nodiscard]] DepthFrame read(std::size_t i);
  void read(std::size_t i, DepthFrame& frame);

 private:
  friend class Session;
  std::unique_ptr<RecordingReader> reader_;
};

}  // namespace depthmocap

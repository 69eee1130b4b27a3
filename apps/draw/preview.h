#pragma once
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "depthmocap/camera_model.h"
#include "depthmocap/image.h"
#include "depthmocap/marker_set.h"
#include "libtracker/recording/track_files.h"

namespace depthmocap {

// What one preview picture shows. Pointers need to be valid during the call only.
struct PreviewFrame {
  const DepthImage* depth = nullptr;   // [m]; required
  const PartImage* labels = nullptr;   // null or empty: no parts are known
  const MarkerSet* markers = nullptr;  // camera frame [m]; null: none
  const JointsRow* joints = nullptr;   // camera frame [m], with frame number, time and state; null: nothing is known
  std::string caption = {};            // one more short text for the bottom line
  std::span<const JointsRow> others = {};  // of several people all but the first
};

inline constexpr int kPreviewWidth = 1280;  // [px] of every preview picture
inline constexpr int kPreviewHeight = 520;

// A film of the tracking: the depth image with parts, markers and skeleton beside the same seen from the side. MP4,
// H.264 where this OpenCV can write it, else MPEG-4 part 2. The file appears at `path` when it is complete: with
// finish(), or with the destructor if any frame was written.
class PreviewWriter {
 public:
  // `camera` of the depth images; `fps` [1/s] (> 0) of the recording. Throws Error where the file cannot be written.
  PreviewWriter(const std::filesystem::path& path, const CameraModel& camera, double fps);
  ~PreviewWriter();
  PreviewWriter(PreviewWriter&&) noexcept;
  void write(const PreviewFrame& frame);
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// One PNG with up to 12 preview pictures, spread evenly over all frames that were added. Written by finish(), or by the
// destructor if any frame was added.
class ContactSheet {
 public:
  ContactSheet(const std::filesystem::path& path, const CameraModel& camera);
  ~ContactSheet();
  ContactSheet(ContactSheet&&) noexcept;
  void add(const PreviewFrame& frame);
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap

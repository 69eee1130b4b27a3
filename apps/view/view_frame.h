#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/depth_frame.h"
#include "depthmocap/tracked_frame.h"
#include "libtracker/output/floor_origin.h"

namespace depthmocap {

// Where the player of a recording is. Indices count the frames that are tracked.
struct Playback {
  std::int64_t index = 0;    // of the frame that is shown
  std::int64_t tracked = 0;  // frames that can be shown
  std::int64_t total = 0;    // frames there will be
  bool playing = false;
  double speed = 1;
};

// What a viewer is told besides the tracked frame.
struct ViewFigures {
  double fps = 0;         // [1/s] of the tracker
  double latency_ms = 0;  // from the sensor's time stamp until the outputs had the frame; 0: not live
  int clients = 0;
  bool recording = false;
  std::optional<Playback> playback;
};

// Depth and labels of a message: every step-th pixel.
struct ViewPicture {
  std::vector<std::uint16_t> depth_mm;  // 0 = no measurement
  std::vector<std::uint8_t> labels;
};

// Makes the binary message of a frame (docs/reference/stream.md, "frame"): JSON, then the depth picture in millimetres
// and the part labels, at half the size or less. Keeps the height of the floor from frame to frame.
class ViewFrameEncoder {
 public:
  explicit ViewFrameEncoder(const CameraModel& camera);
  // `depth` and `labels` (everybody's, see labelsOfAll) at full size; labels may be empty. Reuses the memory of
  // `picture`.
  void pick(const DepthImage& depth, const PartImage& labels, ViewPicture& picture) const;
  // `people`: everybody who may be tracked, by their numbers (>= 1).
  std::string encode(const ViewPicture& picture, std::span<const TrackedFrame> people, const ViewFigures& figures);
  // Labels as they are in the message: every step-th pixel.
  [[nodiscard]] int step() const { return step_; }

 private:
  [[nodiscard]] std::string head(std::span<const TrackedFrame> people, const ViewFigures& figures);
  void followFloor(std::span<const TrackedFrame> people);

  CameraModel camera_;
  int step_;
  int width_;  // [px] of the picture
  int height_;
  FloorOrigin floor_;
  double floor_y_ = 0;
};

}  // namespace depthmocap

#include "libtracker/recording/turned_recording.h"

#include <utility>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr int kQuarter_deg = 90;
constexpr int kFullTurn_deg = 360;

// A ray (x, y) becomes (-y, x). In the lens model p1 belongs to y and p2 to x, so they become (p2, -p1).
CameraModel quarterTurned(const CameraModel& camera) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  CameraModel turned;
  turned.width = camera.height;
  turned.height = camera.width;
  turned.fx = camera.fy;
  turned.fy = camera.fx;
  turned.cx = camera.height - 1 - camera.cy;
  turned.cy = camera.cx;
  turned.distortion = {k1, k2, p2, -p1, k3};
  return turned;
}

class TurnedReader : public RecordingReader {
 public:
  TurnedReader(std::unique_ptr<RecordingReader> recording, int turn_deg)
      : recording_(std::move(recording)), turn_deg_(turn_deg), info_(recording_->info()) {
    info_.camera = turnedCamera(info_.camera, turn_deg);
  }
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  [[nodiscard]] std::size_t frameCount() const override { return recording_->frameCount(); }
  [[nodiscard]] std::int64_t frameNumber(std::size_t i) const override { return recording_->frameNumber(i); }
  [[nodiscard]] double time(std::size_t i) const override { return recording_->time(i); }
  void believe(const CameraModel& camera, double depth_unit_m) override {
    recording_->believe(turnedCamera(camera, (kFullTurn_deg - turn_deg_) % kFullTurn_deg), depth_unit_m);
    info_.camera = camera;
    info_.depth_unit_m = depth_unit_m;
  }
  void read(std::size_t i, DepthFrame& frame) override {
    recording_->read(i, taken_);
    frame.frame = taken_.frame;
    frame.time_s = taken_.time_s;
    turnDepth(taken_.depth, turn_deg_, frame.depth);
  }

 private:
  std::unique_ptr<RecordingReader> recording_;
  int turn_deg_;
  RecordingInfo info_;
  DepthFrame taken_;
};

}  // namespace

CameraModel turnedCamera(const CameraModel& camera, int turn_deg) {
  DMC_CHECK(turn_deg >= 0 && turn_deg < 4 * kQuarter_deg && turn_deg % kQuarter_deg == 0);
  CameraModel turned = camera;
  for (int done = 0; done < turn_deg; done += kQuarter_deg) turned = quarterTurned(turned);
  return turned;
}

void turnDepth(const DepthImage& in, int turn_deg, DepthImage& out) {
  DMC_CHECK(turn_deg >= 0 && turn_deg < 4 * kQuarter_deg && turn_deg % kQuarter_deg == 0);
  const bool on_side = turn_deg % (2 * kQuarter_deg) != 0;
  out.width = on_side ? in.height : in.width;
  out.height = on_side ? in.width : in.height;
  out.data.resize(in.data.size());
  for (int v = 0; v < in.height; ++v) {
    for (int u = 0; u < in.width; ++u) {
      const float depth_m = in.at(u, v);
      if (turn_deg == 0) out.at(u, v) = depth_m;
      if (turn_deg == 90) out.at(in.height - 1 - v, u) = depth_m;
      if (turn_deg == 180) out.at(in.width - 1 - u, in.height - 1 - v) = depth_m;
      if (turn_deg == 270) out.at(v, in.width - 1 - u) = depth_m;
    }
  }
}

std::unique_ptr<RecordingReader> turnedRecording(std::unique_ptr<RecordingReader> recording, int turn_deg) {
  if (turn_deg == 0) return recording;
  return std::make_unique<TurnedReader>(std::move(recording), turn_deg);
}

}  // namespace depthmocap

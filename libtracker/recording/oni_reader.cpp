#include "libtracker/recording/oni_reader.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/core/check_camera.h"
#include "libtracker/recording/oni_codec.h"
#include "libtracker/recording/oni_file.h"
#include "libtracker/recording/undistort.h"
#include "libtracker/recording/usual_camera.h"

namespace depthmocap {

namespace {

constexpr double kSmallestStep_s = 1e-6;

// Numbers and times from 0, both growing: some recorders wrote the same number or time twice.
void tidy(std::vector<OniPicture>& pictures) {
  const OniPicture first = pictures.front();
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    pictures[i].frame -= first.frame;
    pictures[i].time_s -= first.time_s;
    if (i == 0) continue;
    pictures[i].frame = std::max(pictures[i].frame, pictures[i - 1].frame + 1);
    pictures[i].time_s = std::max(pictures[i].time_s, pictures[i - 1].time_s + kSmallestStep_s);
  }
}

double focalLength(int pixels, int width, double fov) {
  return fov > 0 ? pixels / (2.0 * std::tan(fov / 2.0)) : kPrimeSenseFocal * width;
}

RecordingInfo infoOf(const OniDepth& depth, const std::filesystem::path& file) {
  RecordingInfo info;
  CameraModel& camera = info.camera;
  camera.width = depth.width;
  camera.height = depth.height;
  camera.fx = focalLength(camera.width, camera.width, depth.fov_x);
  camera.fy = focalLength(camera.height, camera.width, depth.fov_y);
  camera.cx = 0.5 * camera.width - 0.5;  // not yet checked: a file's width may be the least of all integers
  camera.cy = 0.5 * camera.height - 0.5;
  if (depth.fps > 0) info.fps = depth.fps;
  info.depth_unit_m = depth.depth_unit_m;
  info.camera_name = "openni2";
  info.note = "OpenNI recording " + file.filename().string();
  checkCamera(camera, file.string());
  return info;
}

class OniReader : public RecordingReader {
 public:
  explicit OniReader(const std::filesystem::path& file)
      : where_(file.string()), depth_(readOniFile(file)), info_(infoOf(depth_, file)), stream_(file, std::ios::binary) {
    tidy(depth_.pictures);
    raw_.reset(info_.camera.width, info_.camera.height, 0);
  }
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  [[nodiscard]] std::size_t frameCount() const override { return depth_.pictures.size(); }
  [[nodiscard]] std::int64_t frameNumber(std::size_t i) const override { return depth_.pictures[i].frame; }
  [[nodiscard]] double time(std::size_t i) const override { return depth_.pictures[i].time_s; }
  void read(std::size_t i, DepthFrame& frame) override;
  void believe(const CameraModel& camera, double depth_unit_m) override {
    info_.camera = camera;
    info_.depth_unit_m = depth_unit_m;
    undistortion_.clear();
    if (camera.hasDistortion()) undistortion_ = undistortionMap(camera);
  }

 private:
  std::string where_;
  OniDepth depth_;
  RecordingInfo info_;
  std::ifstream stream_;
  std::string packed_;
  std::vector<std::int32_t> undistortion_;  // empty: none is known
  Image<std::uint16_t> raw_;
};

void OniReader::read(std::size_t i, DepthFrame& frame) {
  DMC_CHECK(i < depth_.pictures.size());
  const OniPicture& picture = depth_.pictures[i];
  packed_.resize(picture.size);
  stream_.clear();
  stream_.seekg(static_cast<std::streamoff>(picture.offset));
  if (!stream_.read(packed_.data(), static_cast<std::streamsize>(packed_.size()))) {
    throw Error(fmt::format("picture {} cannot be read: {}", i, std::strerror(errno)), where_);
  }
  if (!unpackOniPicture(depth_.codec, packed_, raw_.data)) {
    throw Error(fmt::format("picture {} is damaged, or packed with the unknown codec {:.4}", i,
                            std::string(depth_.codec.data(), depth_.codec.size())),
                where_);
  }
  if (depth_.mirrored) {
    for (int y = 0; y < raw_.height; ++y) std::reverse(&raw_.at(0, y), &raw_.at(0, y) + raw_.width);
  }
  frame.frame = picture.frame;
  frame.time_s = picture.time_s;
  toMetres(raw_, info_.depth_unit_m, undistortion_, frame.depth);
}

}  // namespace

std::unique_ptr<RecordingReader> openOniRecording(const std::filesystem::path& file) {
  return std::make_unique<OniReader>(file);
}

}  // namespace depthmocap

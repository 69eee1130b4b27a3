#include "forest/train/recorded_image_source.h"

#include <opencv2/core.hpp>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "depthmocap/parts.h"
#include "forest/train/write_picture.h"
#include "libtracker/recording/part_colors.h"
#include "libtracker/recording/png_file.h"

namespace depthmocap {
namespace {

std::filesystem::path labelFile(const std::filesystem::path& recording, std::int64_t frame) {
  return recording / "truth" / "labels" / fmt::format("{:06d}.png", frame);
}

}  // namespace

RecordedImageSource::RecordedImageSource(const std::filesystem::path& recording, std::size_t step)
    : path_(recording),
      step_(step),
      has_labels_(std::filesystem::is_directory(recording / "truth" / "labels")),
      reader_(openRecording(recording)) {
  if (step < 1) throw Error("every 0-th frame cannot be taken", "step", "use 1 or more");
}

std::size_t RecordedImageSource::count() const {
  return (reader_->frameCount() + step_ - 1) / step_;
}

void RecordedImageSource::render(std::size_t i, TrainingImage& image) {
  image.facing.reset();
  DepthFrame frame;
  {
    const std::lock_guard lock(mutex_);
    reader_->read(i * step_, frame);
    image.focal_px = reader_->info().camera.fx;
  }
  if (!has_labels_) {
    image.labels.reset(frame.depth.width, frame.depth.height, 0);
    image.depth = std::move(frame.depth);
    return;
  }
  readPng8(labelFile(path_, frame.frame), frame.depth.width, frame.depth.height, image.labels);
  image.depth = std::move(frame.depth);
  for (std::size_t p = 0; p < image.depth.data.size(); ++p) {
    if (image.labels.data[p] == 0) image.depth.data[p] = 0;
  }
}

void writeColouredLabels(const PartImage& labels, const std::filesystem::path& path) {
  cv::Mat picture(labels.height, labels.width, CV_8UC3);
  for (int y = 0; y < labels.height; ++y) {
    for (int x = 0; x < labels.width; ++x) {
      const auto& rgb = kPartColors[labels.at(x, y)];
      picture.at<cv::Vec3b>(y, x) = {rgb[2], rgb[1], rgb[0]};
    }
  }
  writePicture(picture, path);
}

}  // namespace depthmocap

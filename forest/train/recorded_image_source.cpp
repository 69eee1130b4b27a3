#include "forest/train/recorded_image_source.h"

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "depthmocap/parts.h"
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

}  // namespace depthmocap

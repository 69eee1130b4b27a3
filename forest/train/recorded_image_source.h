#pragma once
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "forest/train/training_image.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {

// The frames of a recording. With true labels in truth/labels (a synthesised one) the labelled pixels are the actor;
// without, every measured pixel is, and no label is known: only for recordings whose background was removed.
class RecordedImageSource : public TrainingImageSource {
 public:
  // Every step-th frame from the first (step >= 1).
  RecordedImageSource(const std::filesystem::path& recording, std::size_t step);

  [[nodiscard]] bool hasLabels() const { return has_labels_; }
  [[nodiscard]] std::size_t count() const override;
  [[nodiscard]] std::string description() const override { return "recording " + path_.filename().string(); }
  void render(std::size_t i, TrainingImage& image) override;

 private:
  std::filesystem::path path_;
  std::size_t step_;
  bool has_labels_;
  std::mutex mutex_;  // a reader is not for several threads
  std::unique_ptr<RecordingReader> reader_;
};

}  // namespace depthmocap

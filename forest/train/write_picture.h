#pragma once
#include <filesystem>

#include "forest/train/training_image.h"

namespace cv {
class Mat;
}

namespace depthmocap {

// Writes `picture` as PNG. Throws Error where that fails.
void writePicture(const cv::Mat& picture, const std::filesystem::path& path);

// Side by side: depth in grey (near is bright), the true labels, and those that were found. Throws Error where that
// fails.
void writeComparison(const TrainingImage& image, const PartImage& found, const std::filesystem::path& path);

}  // namespace depthmocap

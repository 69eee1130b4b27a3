#pragma once
#include <filesystem>

namespace cv {
class Mat;
}

namespace depthmocap {

// Writes `picture` as PNG. Throws Error where that fails.
void writePicture(const cv::Mat& picture, const std::filesystem::path& path);

}  // namespace depthmocap

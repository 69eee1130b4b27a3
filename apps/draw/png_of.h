#pragma once
#include <opencv2/core/mat.hpp>
#include <string>

namespace depthmocap {

// A picture of 8 bits a channel, grey or BGR, as the bytes of a PNG file.
std::string pngOf(const cv::Mat& picture);

}  // namespace depthmocap

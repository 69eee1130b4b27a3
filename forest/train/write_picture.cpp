#include "forest/train/write_picture.h"

#include <opencv2/core.hpp>

#include "libtracker/core/atomic_file.h"
#include "libtracker/recording/part_colors.h"
#include "libtracker/recording/png_file.h"

namespace depthmocap {
namespace {

constexpr float kFarthestGrey_m = 6.0F;  // [m] from here on depth is black

cv::Vec3b colourOf(std::uint8_t label) {
  const auto& rgb = kPartColors[label];
  return {rgb[2], rgb[1], rgb[0]};
}

}  // namespace

void writePicture(const cv::Mat& picture, const std::filesystem::path& path) {
  writeFileAtomically(path, pngBytes({picture.data, picture.cols, picture.rows, picture.channels(), picture.step}));
}

void writeComparison(const TrainingImage& image, const PartImage& found, const std::filesystem::path& path) {
  const int width = image.depth.width;
  cv::Mat picture(image.depth.height, 3 * width, CV_8UC3);
  for (int y = 0; y < image.depth.height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float z = image.depth.at(x, y);
      const auto grey = z > 0 ? cv::saturate_cast<unsigned char>(255 - 255 * z / kFarthestGrey_m) : 0;
      picture.at<cv::Vec3b>(y, x) = cv::Vec3b::all(static_cast<unsigned char>(grey));
      picture.at<cv::Vec3b>(y, width + x) = colourOf(image.labels.at(x, y));
      picture.at<cv::Vec3b>(y, 2 * width + x) = colourOf(found.at(x, y));
    }
  }
  writePicture(picture, path);
}

}  // namespace depthmocap

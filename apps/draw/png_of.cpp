#include "apps/draw/png_of.h"

#include "libtracker/core/check.h"
#include "libtracker/recording/png_file.h"

namespace depthmocap {

std::string pngOf(const cv::Mat& picture) {
  DMC_CHECK(picture.depth() == CV_8U && (picture.channels() == 1 || picture.channels() == 3));
  return pngBytes({picture.data, picture.cols, picture.rows, picture.channels(), picture.step});
}

}  // namespace depthmocap

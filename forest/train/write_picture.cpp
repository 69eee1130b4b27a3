#include "forest/train/write_picture.h"

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"

namespace depthmocap {

void writePicture(const cv::Mat& picture, const std::filesystem::path& path) {
  std::vector<unsigned char> png;
  if (!cv::imencode(".png", picture, png)) throw Error("cannot encode the picture", path.string());
  writeFileAtomically(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace depthmocap

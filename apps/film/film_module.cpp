#include <opencv2/core/utils/logger.hpp>
#include <opencv2/videoio.hpp>

#include "apps/film/film.h"

namespace depthmocap {
namespace {

class VideoFilm : public Film {
 public:
  VideoFilm(const cv::VideoWriter& video, const cv::Size& size) : video_(video), size_(size) {}
  void write(const std::uint8_t* bgr) override {
    video_.write(cv::Mat(size_, CV_8UC3, const_cast<std::uint8_t*>(bgr)));  // OpenCV does not change it
  }
  void close() override { video_.release(); }

 private:
  cv::VideoWriter video_;
  cv::Size size_;
};

}  // namespace
}  // namespace depthmocap

extern "C" __attribute__((visibility("default"))) depthmocap::Film* openFilmModule(const char* path, double fps,
                                                                                   int width, int height) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // failures are ours to report
  const cv::Size size(width, height);
  cv::VideoWriter video;
  for (const char* codec : {"avc1", "mp4v"}) {
    const int fourcc = cv::VideoWriter::fourcc(codec[0], codec[1], codec[2], codec[3]);
    if (video.open(path, cv::CAP_FFMPEG, fourcc, fps, size)) return new depthmocap::VideoFilm(video, size);
  }
  return nullptr;
}

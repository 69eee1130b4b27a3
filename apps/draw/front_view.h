#pragma once
#include <opencv2/core.hpp>

#include "apps/draw/preview.h"

namespace depthmocap {

// How a lamp beside the camera would light the measured surface: [0, 1], 32-bit float, one value per depth pixel; 0
// where nothing is measured. Shows form where plain depth is nearly flat.
cv::Mat shadeDepth(const DepthImage& depth, const CameraModel& camera);

// The depth image with the actor's parts, markers and skeleton. A small actor is enlarged, at most twice; the view
// follows with a time constant of one second.
class FrontView {
 public:
  explicit FrontView(const CameraModel& camera) : camera_(camera) {}
  // Draws over the whole of `panel` (8-bit BGR).
  void draw(const PreviewFrame& frame, const cv::Mat& shading, cv::Mat& panel);

 private:
  void follow(const PreviewFrame& frame, const cv::Size& panel);
  void drawPixels(const PreviewFrame& frame, const cv::Mat& shading, cv::Mat& panel) const;

  CameraModel camera_;
  bool has_focus_ = false;
  double last_time_s_ = 0;
  cv::Point2d focus_;  // [px] of the depth image, in the middle of the panel
  double scale_ = 1;   // panel pixels a depth pixel
};

}  // namespace depthmocap

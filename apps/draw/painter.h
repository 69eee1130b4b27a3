#pragma once
#include <opencv2/core.hpp>

#include "apps/draw/front_view.h"
#include "apps/draw/preview.h"
#include "apps/draw/side_view.h"

namespace depthmocap {

// Draws preview pictures, kPreviewWidth x kPreviewHeight, 8-bit BGR. Remembers where the actor was, so that the view
// from the side follows smoothly: one object per film, frames in order.
class PreviewPainter {
 public:
  explicit PreviewPainter(const CameraModel& camera);
  // The picture is valid until the next call.
  const cv::Mat& draw(const PreviewFrame& frame);

 private:
  CameraModel camera_;
  FrontView front_view_;
  SideView side_view_;
  cv::Mat canvas_;
};

}  // namespace depthmocap

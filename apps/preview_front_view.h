#pragma once
#include <opencv2/core.hpp>

#include "apps/preview.h"

namespace depthmocap {

// How a lamp beside the camera would light the measured surface: [0, 1], 32-bit float, one value a depth pixel; 0 where
// nothing is measured. Shows form where plain depth is nearly flat.
cv::Mat shadeDepth(const DepthImage& depth, const CameraModel& camera);

// The depth image with the actor's parts, markers and skeleton, fitted into `panel` (8-bit BGR).
void drawFrontView(const PreviewFrame& frame, const CameraModel& camera, const cv::Mat& shading, cv::Mat& panel);

}  // namespace depthmocap

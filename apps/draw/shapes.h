#pragma once
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "depthmocap/marker_set.h"
#include "libtracker/recording/track_files.h"

namespace depthmocap {

// Drawing shared by the views of a preview. Colours are BGR.
inline const cv::Scalar kLeftColor(255, 170, 50);
inline const cv::Scalar kRightColor(85, 95, 255);
inline const cv::Scalar kMiddleColor(245, 245, 245);
inline const cv::Scalar kTextColor(225, 225, 225);

cv::Scalar partColor(int part);  // Part as in a label image

using JointPixels = std::array<std::optional<cv::Point2f>, kJointCount>;
using MarkerPixels = std::array<std::optional<cv::Point2f>, kPartCount>;

// Bones as anti-aliased lines: left, right and middle in their colours, dimmed where a joint is not observed.
void drawSkeleton(const JointPixels& joints, const JointsRow& row, cv::Mat& image);
void drawMarkers(const MarkerPixels& markers, cv::Mat& image);
void drawText(const std::string& text, cv::Point at, double size, const cv::Scalar& color, cv::Mat& image);
// Width [px] that drawText needs.
int textWidth(const std::string& text, double size);

}  // namespace depthmocap

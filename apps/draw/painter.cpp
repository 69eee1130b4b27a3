#include "apps/draw/painter.h"

#include <opencv2/imgproc.hpp>

#include <fmt/format.h>

#include "apps/draw/shapes.h"
#include "libtracker/core/check.h"

namespace depthmocap {

namespace {

constexpr int kPanelWidth = kPreviewWidth / 2;
constexpr int kPanelHeight = 480;
constexpr int kBarHeight = kPreviewHeight - kPanelHeight;
constexpr double kTextSize = 0.5;
const cv::Scalar kBarColor(22, 19, 17);
const cv::Scalar kLineColor(70, 62, 56);
const cv::Scalar kTitleColor(170, 165, 160);

cv::Scalar stateColor(TrackState state) {
  switch (state) {
    case TrackState::Tracking:
      return {110, 200, 90};
    case TrackState::Coasting:
      return {60, 180, 250};
    case TrackState::Lost:
      return {80, 80, 240};
  }
  return kTextColor;
}

void drawCaption(const PreviewFrame& frame, cv::Mat& bar) {
  const int base = bar.rows / 2 + 6;
  int x = 16;
  if (frame.joints != nullptr) {
    const JointsRow& row = *frame.joints;
    cv::circle(bar, {x + 5, bar.rows / 2}, 6, stateColor(row.state), cv::FILLED, cv::LINE_AA);
    const std::string state(trackStateName(row.state));
    drawText(state, {x + 20, base}, kTextSize, stateColor(row.state), bar);
    drawText(fmt::format("frame {}   {:.2f} s", row.frame, row.time_s), {x + 110, base}, kTextSize, kTextColor, bar);
    x += 300;
  }
  drawText(frame.caption, {x, base}, kTextSize, kTitleColor, bar);
}

void drawLegend(cv::Mat& bar) {
  const int middle = bar.rows / 2;
  int x = bar.cols - 16;
  const auto addLine = [&](const std::string& text, const cv::Scalar& color) {
    x -= textWidth(text, kTextSize);
    drawText(text, {x, middle + 6}, kTextSize, kTextColor, bar);
    cv::line(bar, {x - 32, middle}, {x - 10, middle}, color, 4, cv::LINE_AA);
    x -= 56;
  };
  addLine("actor's right", kRightColor);
  addLine("actor's left", kLeftColor);
  const std::string text = "marker";
  x -= textWidth(text, kTextSize);
  drawText(text, {x, middle + 6}, kTextSize, kTextColor, bar);
  cv::circle(bar, {x - 16, middle}, 6, {255, 255, 255}, cv::FILLED, cv::LINE_AA);
  cv::circle(bar, {x - 16, middle}, 4, partColor(static_cast<int>(Part::Torso)), cv::FILLED, cv::LINE_AA);
}

}  // namespace

PreviewPainter::PreviewPainter(const CameraModel& camera)
    : camera_(camera),
      front_view_(camera),
      side_view_(camera),
      canvas_(kPreviewHeight, kPreviewWidth, CV_8UC3, kBarColor) {}

const cv::Mat& PreviewPainter::draw(const PreviewFrame& frame) {
  DMC_CHECK(frame.depth != nullptr && frame.depth->width == camera_.width && frame.depth->height == camera_.height);
  DMC_CHECK(frame.labels == nullptr || frame.labels->empty() || frame.labels->data.size() == frame.depth->data.size());
  const cv::Mat shading = shadeDepth(*frame.depth, camera_);
  cv::Mat front = canvas_(cv::Rect(0, 0, kPanelWidth, kPanelHeight));
  cv::Mat side = canvas_(cv::Rect(kPanelWidth, 0, kPanelWidth, kPanelHeight));
  cv::Mat bar = canvas_(cv::Rect(0, kPanelHeight, kPreviewWidth, kBarHeight));
  front_view_.draw(frame, shading, front);
  side_view_.draw(frame, shading, side);
  drawText("depth camera", {14, 24}, kTextSize, kTitleColor, front);
  drawText("from the side, the camera is on the left", {14, 24}, kTextSize, kTitleColor, side);
  cv::line(canvas_, {kPanelWidth, 0}, {kPanelWidth, kPanelHeight}, kLineColor, 1);
  bar.setTo(kBarColor);
  drawCaption(frame, bar);
  drawLegend(bar);
  return canvas_;
}

}  // namespace depthmocap

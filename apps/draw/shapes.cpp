#include "apps/draw/shapes.h"

#include <opencv2/imgproc.hpp>

#include "libtracker/core/stick_figure.h"
#include "libtracker/recording/part_colors.h"

namespace depthmocap {

namespace {

constexpr int kSubpixelBits = 4;  // OpenCV draws anti-aliased shapes at 1/16 px
const cv::Scalar kOutline(25, 22, 20);

cv::Point subpixel(const cv::Point2f& p) {
  constexpr float kScale = 1 << kSubpixelBits;
  return {cvRound(p.x * kScale), cvRound(p.y * kScale)};
}

void line(cv::Mat& image, const cv::Point2f& a, const cv::Point2f& b, const cv::Scalar& color, int thickness) {
  cv::line(image, subpixel(a), subpixel(b), color, thickness, cv::LINE_AA, kSubpixelBits);
}

void disc(cv::Mat& image, const cv::Point2f& at, float radius, const cv::Scalar& color) {
  cv::circle(image, subpixel(at), cvRound(radius * (1 << kSubpixelBits)), color, cv::FILLED, cv::LINE_AA,
             kSubpixelBits);
}

cv::Scalar sideColor(Joint joint) {
  const std::string_view name = kJointNames[static_cast<std::size_t>(joint)];
  if (name.starts_with("left")) return kLeftColor;
  if (name.starts_with("right")) return kRightColor;
  return kMiddleColor;
}

bool isObserved(const JointsRow& row, Joint joint) {
  return row.confidence[static_cast<int>(joint)] > 0;
}

void drawBones(const JointPixels& joints, const JointsRow& row, bool observed, cv::Mat& image) {
  const auto pixel = [&](Joint joint) { return joints[static_cast<std::size_t>(joint)]; };
  for (const bool outline : {true, false}) {
    for (const BoneLine& bone : kBoneLines) {
      if (!pixel(bone.from) || !pixel(bone.to) || isObserved(row, bone.to) != observed) continue;
      line(image, *pixel(bone.from), *pixel(bone.to), outline ? kOutline : sideColor(bone.to), outline ? 6 : 3);
    }
  }
  for (int j = 0; j < kJointCount; ++j) {
    const auto joint = static_cast<Joint>(j);
    if (!pixel(joint) || isObserved(row, joint) != observed) continue;
    disc(image, *pixel(joint), 5.0F, kOutline);
    disc(image, *pixel(joint), 3.5F, sideColor(joint));
  }
}

}  // namespace

cv::Scalar partColor(int part) {
  const auto& rgb = kPartColors[static_cast<std::size_t>(part)];
  return {static_cast<double>(rgb[2]), static_cast<double>(rgb[1]), static_cast<double>(rgb[0])};
}

void drawSkeleton(const JointPixels& joints, const JointsRow& row, cv::Mat& image) {
  if ((row.confidence.array() == 0).any()) {
    cv::Mat dimmed = image.clone();
    drawBones(joints, row, false, dimmed);
    cv::addWeighted(dimmed, 0.45, image, 0.55, 0.0, image);
  }
  drawBones(joints, row, true, image);
}

void drawMarkers(const MarkerPixels& markers, cv::Mat& image) {
  for (int part = 0; part < kPartCount; ++part) {
    const auto& at = markers[static_cast<std::size_t>(part)];
    if (!at) continue;
    disc(image, *at, 6.5F, kOutline);
    disc(image, *at, 5.5F, cv::Scalar(255, 255, 255));
    disc(image, *at, 3.5F, partColor(part + 1));
  }
}

void drawText(const std::string& text, cv::Point at, double size, const cv::Scalar& color, cv::Mat& image) {
  cv::putText(image, text, at, cv::FONT_HERSHEY_DUPLEX, size, color, 1, cv::LINE_AA);
}

int textWidth(const std::string& text, double size) {
  int baseline = 0;
  return cv::getTextSize(text, cv::FONT_HERSHEY_DUPLEX, size, 1, &baseline).width;
}

}  // namespace depthmocap

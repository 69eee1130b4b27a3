#include "forest/train/report_picture.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "forest/train/write_picture.h"

namespace depthmocap {
namespace {

constexpr int kCell_px = 44;
constexpr int kNames_px = 150;
constexpr int kMatrix_px = kNames_px + kCell_px * kPartCount + 20;
constexpr int kCurve_px = 420;
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kLine(190, 110, 30);

void write(cv::Mat& picture, const std::string& text, int x, int y, double size, const cv::Scalar& colour = kInk) {
  cv::putText(picture, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

void drawCell(cv::Mat& picture, int row, int column, double share) {
  const cv::Rect cell(kNames_px + column * kCell_px, kNames_px + row * kCell_px, kCell_px - 1, kCell_px - 1);
  const double dark = 1.0 - std::min(1.0, share);
  cv::rectangle(picture, cell, cv::Scalar(90 + 165 * dark, 60 + 195 * dark, 20 + 235 * dark), cv::FILLED);
  if (share < 0.005) return;
  const cv::Scalar colour = share > 0.5 ? cv::Scalar(255, 255, 255) : kInk;
  write(picture, fmt::format("{:.0f}", 100 * share), cell.x + (share < 0.095 ? 17 : 12), cell.y + 27, 0.42, colour);
}

void drawMatrix(const ConfusionMatrix& confusion, cv::Mat& picture) {
  for (int row = 0; row < kPartCount; ++row) {
    const std::string name(kPartNames[static_cast<std::size_t>(row) + 1]);
    write(picture, name, 8, kNames_px + row * kCell_px + 27, 0.42);
    // Column names stand upright: written on a strip that is turned.
    cv::Mat strip(kCell_px, kNames_px, CV_8UC3, cv::Scalar::all(255));
    write(strip, name, 6, 27, 0.42);
    cv::Mat turned;
    cv::rotate(strip, turned, cv::ROTATE_90_COUNTERCLOCKWISE);
    turned.copyTo(picture(cv::Rect(kNames_px + row * kCell_px, 0, kCell_px, kNames_px)));
    const auto& counts = confusion.count[static_cast<std::size_t>(row)];
    double all = 0;
    for (const auto n : counts) all += static_cast<double>(n);
    for (int column = 0; column < kPartCount; ++column) {
      const auto n = static_cast<double>(counts[static_cast<std::size_t>(column)]);
      drawCell(picture, row, column, all > 0 ? n / all : 0.0);
    }
  }
}

void drawCurve(const std::vector<CurvePoint>& curve, const std::string& title, cv::Mat picture) {
  const cv::Rect frame(60, 40, picture.cols - 90, picture.rows - 80);
  write(picture, title, frame.x, 25, 0.5);
  if (curve.empty()) return;
  for (int percent = 0; percent <= 100; percent += 20) {
    const int y = frame.y + frame.height * (100 - percent) / 100;
    cv::line(picture, {frame.x, y}, {frame.x + frame.width, y}, cv::Scalar::all(220), 1);
    write(picture, fmt::format("{} %", percent), 10, y + 5, 0.4);
  }
  const auto at = [&](std::size_t i) {
    const auto last = static_cast<double>(std::max<std::size_t>(curve.size() - 1, 1));
    const double along = curve.size() == 1 ? 0.5 : static_cast<double>(i) / last;
    return cv::Point(frame.x + 15 + static_cast<int>(along * (frame.width - 30)),
                     frame.y + static_cast<int>((1 - curve[i].mean_accuracy) * frame.height));
  };
  for (std::size_t i = 0; i < curve.size(); ++i) {
    if (i > 0) cv::line(picture, at(i - 1), at(i), kLine, 2, cv::LINE_AA);
    cv::circle(picture, at(i), 4, kLine, cv::FILLED, cv::LINE_AA);
    write(picture, fmt::format("{:.1f}", 100 * curve[i].mean_accuracy), at(i).x - 14, at(i).y - 10, 0.38);
    write(picture, fmt::format("{}", curve[i].x), at(i).x - 8, frame.y + frame.height + 18, 0.4);
  }
}

}  // namespace

void drawReport(const TrainingReport& report, const std::filesystem::path& path) {
  cv::Mat picture(kMatrix_px, kMatrix_px + kCurve_px, CV_8UC3, cv::Scalar::all(255));
  drawMatrix(report.accuracy.all, picture);
  write(picture, "true part in rows, found part in columns, percent of the row", kNames_px, kMatrix_px - 6, 0.42);
  const int height = kMatrix_px / 3;
  const auto panel = [&](int i) { return picture(cv::Rect(kMatrix_px, i * height, kCurve_px, height)); };
  drawCurve(report.by_trees, "mean accuracy by trees", panel(0));
  drawCurve(report.by_depth, "mean accuracy by depth", panel(1));
  drawCurve(report.by_images, report.by_images.empty() ? "" : "mean accuracy of one tree by images", panel(2));
  writePicture(picture, path);
}

}  // namespace depthmocap

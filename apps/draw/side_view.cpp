#include "apps/draw/side_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>

#include "apps/draw/shapes.h"

namespace depthmocap {

namespace {

constexpr double kAzimuth_rad = 70.0 * std::numbers::pi / 180.0;
constexpr double kPitch_rad = 12.0 * std::numbers::pi / 180.0;
constexpr double kEyeDistance_m = 4.5;
constexpr double kVisibleHeight_m = 2.5;
constexpr double kFollowTime_s = 0.3;
constexpr double kGridStep_m = 0.5;
constexpr int kGridReach = 4;  // [steps] around the actor
const cv::Scalar kBackground(36, 31, 28);
const cv::Scalar kGridColor(96, 84, 76);

bool hasSkeleton(const PreviewFrame& frame) {
  return frame.joints != nullptr && frame.joints->state != TrackState::Lost;
}

bool hasLabels(const PreviewFrame& frame) {
  return frame.labels != nullptr && !frame.labels->empty();
}

cv::Scalar mix(const cv::Scalar& a, const cv::Scalar& b, double share_of_a) {
  return a * share_of_a + b * (1 - share_of_a);
}

}  // namespace

// Where to look: the skeleton's middle, or else that of the actor's pixels.
void SideView::follow(const PreviewFrame& frame) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double lowest = 0;
  if (hasSkeleton(frame)) {
    const JointPositions& p = frame.joints->p_camera;
    middle = 0.5 * (p.rowwise().minCoeff() + p.rowwise().maxCoeff());
    lowest = p.row(1).maxCoeff() + 0.03;  // toes lie a little above the sole
  } else {
    Eigen::AlignedBox3d box;
    for (int y = 0; hasLabels(frame) && y < frame.labels->height; y += 4) {
      for (int x = 0; x < frame.labels->width; x += 4) {
        const float z = frame.depth->at(x, y);
        if (frame.labels->at(x, y) != 0 && z > 0) box.extend(camera_.unproject(x, y, static_cast<double>(z)));
      }
    }
    if (box.isEmpty()) return;
    middle = box.center();
    lowest = box.max().y();
  }
  const double time_s = frame.joints != nullptr ? frame.joints->time_s : last_time_s_;
  const double share = has_focus_ ? 1.0 - std::exp(-std::max(0.0, time_s - last_time_s_) / kFollowTime_s) : 1.0;
  const double floor_share = lowest > floor_y_ ? share : 0.1 * share;  // a jump does not lift the floor
  focus_ += share * (middle - focus_);
  floor_y_ += (has_focus_ ? floor_share : 1.0) * (lowest - floor_y_);
  last_time_s_ = time_s;
  has_focus_ = true;
}

void SideView::placeCamera(const cv::Mat& panel) {
  const Eigen::Vector3d down(0, 1, 0);
  const Eigen::Vector3d level(-std::sin(kAzimuth_rad), 0, std::cos(kAzimuth_rad));
  const Eigen::Vector3d forward = std::cos(kPitch_rad) * level + std::sin(kPitch_rad) * down;
  const Eigen::Vector3d right(std::cos(kAzimuth_rad), 0, std::sin(kAzimuth_rad));
  R_view_camera_ << right.transpose(), forward.cross(right).transpose(), forward.transpose();
  eye_ = focus_ - kEyeDistance_m * forward;
  focal_px_ = panel.rows * kEyeDistance_m / kVisibleHeight_m;
  middle_ = {0.5 * panel.cols, 0.5 * panel.rows};
}

SideView::Projected SideView::project(const Eigen::Vector3d& p_camera) const {
  const Eigen::Vector3d p_view = R_view_camera_ * (p_camera - eye_);
  if (!(p_view.z() > 0.1)) return {};
  return {{static_cast<float>(middle_.x + focal_px_ * p_view.x() / p_view.z()),
           static_cast<float>(middle_.y + focal_px_ * p_view.y() / p_view.z())},
          static_cast<float>(p_view.z())};
}

// The grid stands still in the world; only the part around the actor is drawn.
void SideView::drawFloor(cv::Mat& panel) const {
  const double x0 = std::round(focus_.x() / kGridStep_m);
  const double z0 = std::round(focus_.z() / kGridStep_m);
  const auto draw = [&](double xa, double za, double xb, double zb, double fade) {
    const Projected a = project({kGridStep_m * xa, floor_y_, kGridStep_m * za});
    const Projected b = project({kGridStep_m * xb, floor_y_, kGridStep_m * zb});
    if (a.depth > 0 && b.depth > 0)
      cv::line(panel, a.pixel, b.pixel, mix(kGridColor, kBackground, fade), 1, cv::LINE_AA);
  };
  for (int i = -kGridReach; i <= kGridReach; ++i) {
    for (int k = -kGridReach; k < kGridReach; ++k) {
      const double reach = std::max(std::abs(i), std::abs(k + (k < 0 ? 0 : 1)));
      const double fade = std::clamp(1.2 - reach / kGridReach, 0.2, 1.0);
      draw(x0 + i, z0 + k, x0 + i, z0 + k + 1, fade);
      draw(x0 + k, z0 + i, x0 + k + 1, z0 + i, fade);
    }
  }
}

void SideView::drawPoints(const PreviewFrame& frame, const cv::Mat& shading, cv::Mat& panel) {
  nearest_.assign(panel.total(), 1e9F);
  for (int y = 0; y < frame.labels->height; ++y) {
    for (int x = 0; x < frame.labels->width; ++x) {
      const int part = frame.labels->at(x, y);
      const float z = frame.depth->at(x, y);
      if (part == 0 || part > kPartCount || !(z > 0)) continue;
      const Projected p = project(camera_.unproject(x, y, static_cast<double>(z)));
      const cv::Scalar color = partColor(part) * (0.35 + 0.65 * static_cast<double>(shading.at<float>(y, x)));
      if (!(p.depth > 0)) continue;
      const double covered_m = static_cast<double>(z) / camera_.fx;  // by a depth pixel: far points are larger dots
      const int dot =
          std::clamp(static_cast<int>(std::ceil(covered_m * focal_px_ / static_cast<double>(p.depth))), 2, 8);
      const int left = cvRound(p.pixel.x) - dot / 2;
      const int top = cvRound(p.pixel.y) - dot / 2;
      if (left < 0 || top < 0 || left + dot > panel.cols || top + dot > panel.rows) continue;
      for (int k = 0; k < dot * dot; ++k) {
        const int px = left + k % dot;
        const int py = top + k / dot;
        float& nearest = nearest_[static_cast<std::size_t>(py) * static_cast<std::size_t>(panel.cols) +
                                  static_cast<std::size_t>(px)];
        if (p.depth > nearest) continue;
        nearest = p.depth;
        panel.at<cv::Vec3b>(py, px) =
            cv::Vec3b(cv::saturate_cast<std::uint8_t>(color[0]), cv::saturate_cast<std::uint8_t>(color[1]),
                      cv::saturate_cast<std::uint8_t>(color[2]));
      }
    }
  }
}

void SideView::draw(const PreviewFrame& frame, const cv::Mat& shading, cv::Mat& panel) {
  panel.setTo(kBackground);
  follow(frame);
  if (!has_focus_) return;
  placeCamera(panel);
  drawFloor(panel);
  if (hasLabels(frame)) drawPoints(frame, shading, panel);
  if (frame.markers != nullptr) {
    MarkerPixels markers;
    for (int k = 0; k < kPartCount; ++k) {
      const Projected p = project(frame.markers->position.col(k));
      if (frame.markers->seen(k) && p.depth > 0) markers[static_cast<std::size_t>(k)] = p.pixel;
    }
    drawMarkers(markers, panel);
  }
  const auto drawPerson = [&](const JointsRow& row) {
    if (row.state == TrackState::Lost) return;
    JointPixels joints;
    for (int k = 0; k < kJointCount; ++k) {
      const Projected p = project(row.p_camera.col(k));
      if (p.depth > 0) joints[static_cast<std::size_t>(k)] = p.pixel;
    }
    drawSkeleton(joints, row, panel);
  };
  for (const JointsRow& row : frame.others) drawPerson(row);
  if (frame.joints != nullptr) drawPerson(*frame.joints);
}

}  // namespace depthmocap

#include "apps/draw/front_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "apps/draw/shapes.h"

namespace depthmocap {

namespace {

constexpr int kSmoothReach = 2;          // [px] of the smoothing before normals are taken
constexpr float kSmoothRange_m = 0.04F;  // depths farther apart are not averaged
constexpr float kMaxStep_m = 0.08F;      // a larger step between neighbours is an edge, not a slope
const cv::Vec3f kLamp(-0.42F, -0.57F, -0.71F);
constexpr double kActorShare = 0.85;      // of the panel, when the actor is enlarged
constexpr double kMostActorShare = 0.97;  // of the panel, while the view follows
constexpr double kMaxZoom = 2.0;
constexpr double kFollowTime_s = 1.0;
const cv::Scalar kUnmeasured(36, 31, 28);

// Mean of the neighbours at nearly the same depth: depth steps of the sensor would look like terraces otherwise.
DepthImage smoothed(const DepthImage& depth) {
  DepthImage result(depth.width, depth.height, 0.0F);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const float z = depth.at(x, y);
      if (!(z > 0)) continue;
      float sum = 0;
      float count = 0;
      for (int ny = std::max(0, y - kSmoothReach); ny <= std::min(depth.height - 1, y + kSmoothReach); ++ny) {
        for (int nx = std::max(0, x - kSmoothReach); nx <= std::min(depth.width - 1, x + kSmoothReach); ++nx) {
          const float other = depth.at(nx, ny);
          const float use = other > 0 && std::abs(other - z) < kSmoothRange_m ? 1.0F : 0.0F;
          sum += use * other;
          count += use;
        }
      }
      result.at(x, y) = sum / count;
    }
  }
  return result;
}

// Depth change to the next pixel, from the sides that belong to the same surface.
float slope(float before, float here, float after) {
  const bool has_before = before > 0 && std::abs(here - before) < kMaxStep_m;
  const bool has_after = after > 0 && std::abs(after - here) < kMaxStep_m;
  if (has_before && has_after) return 0.5F * (after - before);
  if (has_before) return here - before;
  return has_after ? after - here : 0.0F;
}

cv::Mat paintPixels(const PreviewFrame& frame, const cv::Mat& shading) {
  const DepthImage& depth = *frame.depth;
  const bool has_labels = frame.labels != nullptr && !frame.labels->empty();
  cv::Mat image(depth.height, depth.width, CV_8UC3, kUnmeasured);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const float z = depth.at(x, y);
      if (!(z > 0)) continue;
      const double light = static_cast<double>(shading.at<float>(y, x));
      const int part = has_labels ? frame.labels->at(x, y) : 0;
      const double grey = 190.0 * std::clamp(1.15 - static_cast<double>(z) / 8.0, 0.4, 1.0);
      cv::Scalar color = cv::Scalar(grey, grey, grey) * (has_labels ? 0.7 : 1.0);
      if (part > 0 && part <= kPartCount) color = partColor(part) * 0.85 + cv::Scalar(30, 30, 30);
      color *= 0.3 + 0.7 * light;
      for (int c = 0; c < 3; ++c) image.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<std::uint8_t>(color[c]);
    }
  }
  return image;
}

// Where the actor's pixels are [px].
std::optional<cv::Rect2d> actorBox(const PreviewFrame& frame) {
  if (frame.labels == nullptr || frame.labels->empty()) return std::nullopt;
  int x0 = frame.labels->width;
  int y0 = frame.labels->height;
  int x1 = -1;
  int y1 = -1;
  for (int y = 0; y < frame.labels->height; ++y) {
    for (int x = 0; x < frame.labels->width; ++x) {
      if (frame.labels->at(x, y) == 0) continue;
      x0 = std::min(x0, x);
      y0 = std::min(y0, y);
      x1 = std::max(x1, x);
      y1 = std::max(y1, y);
    }
  }
  if (x1 < 0) return std::nullopt;
  return cv::Rect2d(x0, y0, x1 - x0 + 1, y1 - y0 + 1);
}

// Middle of the view along one axis: the wanted one, but so that the actor [low, high] is inside, and no farther out
// than the image reaches.
double clampedFocus(double wanted, double low, double high, double image_size, double visible) {
  if (visible >= image_size) return 0.5 * image_size;
  const double with_actor =
      high - low < visible ? std::clamp(wanted, high - 0.5 * visible, low + 0.5 * visible) : wanted;
  return std::clamp(with_actor, 0.5 * visible, image_size - 0.5 * visible);
}

}  // namespace

cv::Mat shadeDepth(const DepthImage& depth, const CameraModel& camera) {
  const DepthImage smooth = smoothed(depth);
  cv::Mat shading(depth.height, depth.width, CV_32F, cv::Scalar(0));
  const auto read = [&](int x, int y) { return smooth.contains(x, y) ? smooth.at(x, y) : 0.0F; };
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const float z = smooth.at(x, y);
      if (!(z > 0)) continue;
      const float dx = slope(read(x - 1, y), z, read(x + 1, y)) * static_cast<float>(camera.fx) / z;
      const float dy = slope(read(x, y - 1), z, read(x, y + 1)) * static_cast<float>(camera.fy) / z;
      const cv::Vec3f normal(dx, dy, -1.0F);
      shading.at<float>(y, x) = std::clamp(normal.dot(kLamp) / static_cast<float>(cv::norm(normal)), 0.0F, 1.0F);
    }
  }
  return shading;
}

void FrontView::follow(const PreviewFrame& frame, const cv::Size& panel) {
  const double whole =
      std::min(static_cast<double>(panel.width) / camera_.width, static_cast<double>(panel.height) / camera_.height);
  const std::optional<cv::Rect2d> box = actorBox(frame);
  if (!has_focus_) {
    scale_ = whole;
    focus_ = {0.5 * camera_.width, 0.5 * camera_.height};
  }
  if (!box) return;
  const double fitting = kActorShare * std::min(panel.height / box->height, panel.width / box->width);
  const double wanted_scale = std::clamp(fitting, whole, kMaxZoom * whole);
  const double time_s = frame.joints != nullptr ? frame.joints->time_s : last_time_s_;
  const double share = has_focus_ ? 1.0 - std::exp(-std::max(0.0, time_s - last_time_s_) / kFollowTime_s) : 1.0;
  scale_ += share * (wanted_scale - scale_);
  scale_ = std::min(scale_, std::max(whole, fitting / kActorShare * kMostActorShare));
  const cv::Point2d wanted(box->x + 0.5 * box->width, box->y + 0.5 * box->height);
  focus_ += share * (wanted - focus_);
  focus_ = {clampedFocus(focus_.x, box->x, box->x + box->width, camera_.width, panel.width / scale_),
            clampedFocus(focus_.y, box->y, box->y + box->height, camera_.height, panel.height / scale_)};
  last_time_s_ = time_s;
  has_focus_ = true;
}

void FrontView::drawPixels(const PreviewFrame& frame, const cv::Mat& shading, cv::Mat& panel) const {
  const cv::Mat to_panel = (cv::Mat_<double>(2, 3) << scale_, 0, 0.5 * panel.cols + scale_ * (0.5 - focus_.x) - 0.5, 0,
                            scale_, 0.5 * panel.rows + scale_ * (0.5 - focus_.y) - 0.5);
  cv::warpAffine(paintPixels(frame, shading), panel, to_panel, panel.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT,
                 kUnmeasured);
}

void FrontView::draw(const PreviewFrame& frame, const cv::Mat& shading, cv::Mat& panel) {
  follow(frame, panel.size());
  drawPixels(frame, shading, panel);
  const auto toPanel = [&](const Eigen::Vector3d& p_camera) -> std::optional<cv::Point2f> {
    if (!(p_camera.z() > 0.1)) return std::nullopt;
    const Eigen::Vector2d pixel = camera_.project(p_camera) + Eigen::Vector2d::Constant(0.5);
    return cv::Point2f(static_cast<float>(0.5 * panel.cols + scale_ * (pixel.x() - focus_.x)),
                       static_cast<float>(0.5 * panel.rows + scale_ * (pixel.y() - focus_.y)));
  };
  if (frame.markers != nullptr) {
    MarkerPixels markers;
    for (int k = 0; k < kPartCount; ++k) {
      if (frame.markers->seen(k)) markers[static_cast<std::size_t>(k)] = toPanel(frame.markers->position.col(k));
    }
    drawMarkers(markers, panel);
  }
  const auto drawPerson = [&](const JointsRow& row) {
    if (row.state == TrackState::Lost) return;
    JointPixels joints;
    for (int k = 0; k < kJointCount; ++k) joints[static_cast<std::size_t>(k)] = toPanel(row.p_camera.col(k));
    drawSkeleton(joints, row, panel);
  };
  for (const JointsRow& row : frame.others) drawPerson(row);
  if (frame.joints != nullptr) drawPerson(*frame.joints);
}

}  // namespace depthmocap

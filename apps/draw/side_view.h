#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "apps/draw/preview.h"

namespace depthmocap {

// The actor's pixels as points in space, with markers, skeleton and a floor grid, seen from the camera's right. Follows
// the actor with a time constant of 0.3 s.
class SideView {
 public:
  explicit SideView(const CameraModel& camera) : camera_(camera) {}
  // Draws over the whole of `panel` (8-bit BGR). `shading` [0, 1] is the front view's, one value per depth pixel.
  void draw(const PreviewFrame& frame, const cv::Mat& shading, cv::Mat& panel);

 private:
  struct Projected {
    cv::Point2f pixel;
    float depth = 0;  // [m] from the virtual camera; <= 0: behind it
  };
  void follow(const PreviewFrame& frame);
  void placeCamera(const cv::Mat& panel);
  [[nodiscard]] Projected project(const Eigen::Vector3d& p_camera) const;
  void drawFloor(cv::Mat& panel) const;
  void drawPoints(const PreviewFrame& frame, const cv::Mat& shading, cv::Mat& panel);

  CameraModel camera_;
  bool has_focus_ = false;
  double last_time_s_ = 0;
  Eigen::Vector3d focus_ = Eigen::Vector3d::Zero();  // camera frame [m]: the middle of the actor
  double floor_y_ = 0;                               // [m], y points down
  Eigen::Matrix3d R_view_camera_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d eye_ = Eigen::Vector3d::Zero();  // camera frame [m]
  double focal_px_ = 1;
  cv::Point2d middle_;
  std::vector<float> nearest_;  // [m] z-buffer
};

}  // namespace depthmocap

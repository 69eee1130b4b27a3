#include "apps/calibrate/calibration_picture.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/draw/png_of.h"
#include "apps/draw/shapes.h"
#include "depthmocap/error.h"
#include "depthmocap/world_frame.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr int kPanelWidth = 640;
constexpr int kPanelHeight = 720;
constexpr double kBodyShare = 0.84;  // of the panel's height that the stature takes
constexpr double kSideTurn = 65.0 * std::numbers::pi / 180.0;
constexpr double kSideDown = 12.0 * std::numbers::pi / 180.0;
constexpr int kRingPoints = 40;
constexpr int kRings = 5;
const cv::Scalar kBackground(38, 34, 32);
const cv::Scalar kTorsoColor(210, 130, 190);

// An orthographic view of the body, turned about its vertical axis and seen from above.
class View {
 public:
  View(cv::Mat panel, const Vector3d& center, double stature_m, double turn, double down)
      : panel_(std::move(panel)),
        center_(center),
        scale_(kBodyShare * kPanelHeight / stature_m),
        R_((Eigen::AngleAxisd(down, Vector3d::UnitX()) * Eigen::AngleAxisd(turn, Vector3d::UnitY()))
               .toRotationMatrix()) {
    panel_.setTo(kBackground);
    nearest_ = cv::Mat(panel_.size(), CV_32F, cv::Scalar(-1e9));
  }

  [[nodiscard]] cv::Point2d at(const Vector3d& p_world) const {
    const Vector3d p = R_ * (p_world - center_);
    return {0.5 * kPanelWidth + scale_ * p.x(), 0.5 * kPanelHeight - scale_ * p.y()};
  }

  // A depth point, brighter the nearer it is; points behind others are hidden.
  void addPoint(const Vector3d& p_world) {
    const Vector3d p = R_ * (p_world - center_);
    const cv::Point pixel(at(p_world));
    if (!cv::Rect(0, 0, kPanelWidth - 1, kPanelHeight - 1).contains(pixel)) return;
    const auto grey = static_cast<uchar>(std::clamp(150.0 + 300.0 * p.z(), 70.0, 230.0));
    for (int dy = 0; dy < 2; ++dy) {
      for (int dx = 0; dx < 2; ++dx) {
        auto& nearest = nearest_.at<float>(pixel.y + dy, pixel.x + dx);
        if (static_cast<float>(p.z()) < nearest) continue;
        nearest = static_cast<float>(p.z());
        panel_.at<cv::Vec3b>(pixel.y + dy, pixel.x + dx) = {grey, grey, grey};
      }
    }
  }

  void addLine(const Vector3d& a, const Vector3d& b, const cv::Scalar& color, int width) {
    cv::line(panel_, at(a), at(b), color, width, cv::LINE_AA);
  }

  // A tube of elliptic section between two ends, as rings and four lines along it.
  void addTube(const Vector3d& a, const Vector3d& b, const Vector3d& u, const Vector3d& v, const cv::Scalar& color) {
    const auto on_ring = [&](const Vector3d& center, double angle) {
      return Vector3d(center + std::cos(angle) * u + std::sin(angle) * v);
    };
    for (int ring = 0; ring < kRings; ++ring) {
      const Vector3d center = a + (b - a) * ring / (kRings - 1.0);
      for (int i = 0; i < kRingPoints; ++i) {
        const double step = 2.0 * std::numbers::pi / kRingPoints;
        addLine(on_ring(center, i * step), on_ring(center, (i + 1) * step), color, 1);
      }
    }
    for (int i = 0; i < 4; ++i) {
      const double angle = 0.5 * std::numbers::pi * i;
      addLine(on_ring(a, angle), on_ring(b, angle), color, 1);
    }
  }

  cv::Mat& panel() { return panel_; }

 private:
  cv::Mat panel_;
  cv::Mat nearest_;
  Vector3d center_;
  double scale_;
  Eigen::Matrix3d R_;
};

void drawCloud(const Calibrator::Shown& shown, const CameraModel& camera, View& view) {
  const Eigen::Matrix3d R_world_camera = uprightWorldFromCamera();
  for (int y = 0; y < shown.mask.height; ++y) {
    for (int x = 0; x < shown.mask.width; ++x) {
      const auto depth_m = static_cast<double>(shown.frame.depth.at(x, y));
      if (shown.mask.at(x, y) == 0 || depth_m <= 0) continue;
      view.addPoint(R_world_camera * camera.unproject(x, y, depth_m));
    }
  }
}

void drawLimbs(const FittedLimbs& limbs, View& view) {
  for (int part = 0; part < kPartCount; ++part) {
    const auto& cylinder = limbs.cylinders[static_cast<std::size_t>(part)];
    if (!cylinder) continue;
    const Vector3d u = cylinder->axis.unitOrthogonal() * cylinder->radius;
    const Vector3d v = cylinder->axis.cross(u);
    view.addTube(cylinder->point + cylinder->low * cylinder->axis, cylinder->point + cylinder->high * cylinder->axis, u,
                 v, partColor(part + 1));
  }
  if (!limbs.torso) return;
  const EllipticCylinder& torso = *limbs.torso;
  view.addTube(torso.center + torso.low * torso.axis, torso.center + torso.high * torso.axis,
               torso.side * torso.half_width, torso.side.cross(torso.axis) * torso.half_depth, kTorsoColor);
}

void drawBones(const Actor& actor, const Pose& q, View& view) {
  JointsRow row;
  row.p_camera = jointPositions(actor.skeleton, q);  // in the world: only drawn
  row.confidence.setOnes();
  JointPixels pixels;
  for (int j = 0; j < kJointCount; ++j) {
    pixels[static_cast<std::size_t>(j)] = cv::Point2f(view.at(row.p_camera.col(j)));
  }
  drawSkeleton(pixels, row, view.panel());
}

}  // namespace

void writeCalibrationPicture(const std::filesystem::path& path, const Calibrator::Shown& shown, const Actor& actor,
                             const CameraModel& camera) {
  cv::Mat canvas(kPanelHeight, 2 * kPanelWidth, CV_8UC3);
  const auto& l = actor.skeleton.lengths;
  // The middle of the standing body: between crown and soles.
  const Vector3d center = shown.q.head<3>() + Vector3d(0, l.torso + 1.7 * l.neck_to_head - 0.5 * actor.stature_m(), 0);
  for (int i = 0; i < 2; ++i) {
    View view(canvas(cv::Rect(i * kPanelWidth, 0, kPanelWidth, kPanelHeight)), center,
              std::max(actor.stature_m(), 1.0) * 1.08, i == 0 ? 0.0 : -kSideTurn, i == 0 ? 0.0 : kSideDown);
    drawCloud(shown, camera, view);
    drawLimbs(shown.limbs, view);
    drawBones(actor, shown.q, view);
  }
  drawText(
      fmt::format("stature {:.3f} m   arm {:.3f} + {:.3f}   leg {:.3f} + {:.3f}   torso {:.3f}   shoulders {:.3f}",
                  actor.stature_m(), l.upper_arm, l.lower_arm, l.upper_leg, l.lower_leg, l.torso, l.shoulder_width),
      {16, kPanelHeight - 16}, 0.55, kTextColor, canvas);
  writeFileAtomically(path, pngOf(canvas));
}

}  // namespace depthmocap

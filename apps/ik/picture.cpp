#include "apps/ik/picture.h"

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "apps/draw/png_of.h"
#include "apps/draw/shapes.h"
#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr int kCell_px = 140;
constexpr int kHead_px = 26;
constexpr double kPixelsPerMetre = 70.0;
constexpr double kSide_rad = 0.5;
constexpr double kAbove_rad = 0.2;
const cv::Scalar kGround(40, 36, 34);  // BGR
const cv::Scalar kTargetColor(80, 220, 255);

// Views a pose from the front of the true body, wherever that faces.
class CellView {
 public:
  CellView(const Pose& truth, cv::Point middle) : root_(truth.head<3>()), middle_(middle) {
    R_view_world_ = Eigen::AngleAxisd(kAbove_rad, Eigen::Vector3d::UnitX()) *
                    Eigen::AngleAxisd(kSide_rad - truth[kRootRy], Eigen::Vector3d::UnitY());
  }
  [[nodiscard]] cv::Point2f pixel(const Eigen::Vector3d& p_world) const {
    const Eigen::Vector3d p = kPixelsPerMetre * (R_view_world_ * (p_world - root_));
    return {static_cast<float>(middle_.x + p.x()), static_cast<float>(middle_.y - p.y())};
  }

 private:
  Eigen::Vector3d root_;
  cv::Point middle_;
  Eigen::Matrix3d R_view_world_;
};

void drawPose(const Skeleton& skeleton, const Pose& q, const JointTargets& targets, const CellView& view,
              cv::Mat& image) {
  const JointPositions joints = jointPositions(skeleton, q);
  JointPixels pixels;
  JointsRow row;
  row.state = TrackState::Tracking;
  row.confidence.setOnes();
  for (int i = 0; i < kJointCount; ++i) pixels[static_cast<std::size_t>(i)] = view.pixel(joints.col(i));
  drawSkeleton(pixels, row, image);
  for (int i = 0; i < kJointCount; ++i) {
    if (!targets.has(static_cast<Joint>(i))) continue;
    cv::circle(image, view.pixel(targets.p_world.col(i)), 5, kTargetColor, 1, cv::LINE_AA);
  }
}

}  // namespace

void drawIkPicture(const std::vector<IkTask>& tasks, const std::vector<IkSolver>& solvers,
                   const std::filesystem::path& path) {
  const int columns = 1 + static_cast<int>(solvers.size());
  cv::Mat image(kHead_px + kCell_px * static_cast<int>(tasks.size()), kCell_px * columns, CV_8UC3, kGround);
  for (int column = 0; column < columns; ++column) {
    const bool is_truth = column == 0;
    const std::string title =
        is_truth ? "truth"
                 : std::string(
                       kIkPriorNames[static_cast<std::size_t>(solvers[static_cast<std::size_t>(column) - 1].prior())]);
    drawText(title, {column * kCell_px + 10, 19}, 0.5, kTextColor, image);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      const cv::Point middle(column * kCell_px + kCell_px / 2,
                             kHead_px + static_cast<int>(i) * kCell_px + kCell_px / 2);
      const CellView view(tasks[i].truth, middle);
      const IkSolver& solver = solvers[is_truth ? 0 : static_cast<std::size_t>(column) - 1];
      const Pose q = is_truth ? tasks[i].truth : solver.solve(tasks[i].targets).q;
      drawPose(solver.skeleton(), q, tasks[i].targets, view, image);
    }
  }
  writeFileAtomically(path, pngOf(image));
}

}  // namespace depthmocap

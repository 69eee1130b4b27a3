#include "libtracker/ik/image_term.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "libtracker/core/check.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

// [m] A point nearer to the camera, or behind it, is seen as if it were here.
constexpr double kNearest_m = 0.1;

// How a body, whose root is at the origin, is moved and scaled to lie nearest to the targets.
struct Placed {
  double scale = 0;  // picture units in a metre; not above 0: no such placing
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double error_m = 0;
};

// uv: v up.
Placed placed(const std::vector<Eigen::Vector2d>& xy, const std::vector<Eigen::Vector2d>& uv,
              const ImageTargets& targets) {
  double weight = 0;
  Eigen::Vector2d xy_mean = Eigen::Vector2d::Zero();
  Eigen::Vector2d uv_mean = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < xy.size(); ++i) {
    const double w = targets.targets[i].weight;
    weight += w;
    xy_mean += w * xy[i];
    uv_mean += w * uv[i];
  }
  xy_mean /= weight;
  uv_mean /= weight;
  double across = 0;
  double along = 0;
  double spread = 0;
  for (std::size_t i = 0; i < xy.size(); ++i) {
    const double w = targets.targets[i].weight;
    across += w * (xy[i] - xy_mean).dot(uv[i] - uv_mean);
    along += w * (xy[i] - xy_mean).squaredNorm();
    spread += w * (uv[i] - uv_mean).squaredNorm();
  }
  Placed result;
  if (!(across > 0) || !(along > 0)) return result;
  result.scale = across / along;
  result.middle = uv_mean - result.scale * xy_mean;
  result.error_m = std::sqrt(std::max(0.0, spread - across * result.scale) / weight) / result.scale;
  return result;
}

// The targets with v up, about the camera's axis and in focal lengths where there is a camera.
std::vector<Eigen::Vector2d> upright(const ImageProjection& projection, const ImageTargets& targets) {
  const CameraModel& c = projection.camera;
  std::vector<Eigen::Vector2d> uv;
  for (const ImageTargets::Target& target : targets.targets) {
    const Eigen::Vector2d& p = target.uv;
    uv.push_back(projection.kind == Projection::Orthographic
                     ? p
                     : Eigen::Vector2d((p.x() - c.cx) / c.fx, (c.cy - p.y()) / c.fy));
  }
  return uv;
}

}  // namespace

ImageTerm::ImageTerm(const Skeleton& skeleton, const ImageProjection& projection, ImageTargets targets, double scale,
                     double unit_m)
    : skeleton_(skeleton),
      points_(jointPoints(skeleton)),
      projection_(projection),
      targets_(std::move(targets)),
      scale_(scale),
      unit_m_(unit_m) {
  DMC_CHECK(scale > 0 && unit_m > 0);
}

Eigen::Vector2d ImageTerm::project(const BonePoint& point, const Pose& q, ImageJacobian* J) const {
  const Eigen::Vector3d p = fk_.position(point);
  PointJacobian J_p;
  if (J != nullptr) fk_.jacobian(point, J_p);
  if (projection_.kind == Projection::Orthographic) {
    const double s = scale_ * std::exp(q[kRootTz]);
    if (J != nullptr) {
      *J = s * J_p.topRows<2>();
      J->col(kRootTz) = s * p.head<2>();
    }
    return s * p.head<2>();
  }
  const CameraModel& c = projection_.camera;
  const double depth_m = std::max(kNearest_m, -p.z());
  Eigen::Vector2d uv(c.fx * p.x() / depth_m + c.cx, c.cy - c.fy * p.y() / depth_m);
  if (J != nullptr) {
    const double sinks = -p.z() > kNearest_m ? 1.0 : 0.0;
    J->row(0) = c.fx / depth_m * (J_p.row(0) + sinks * p.x() / depth_m * J_p.row(2));
    J->row(1) = -c.fy / depth_m * (J_p.row(1) + sinks * p.y() / depth_m * J_p.row(2));
  }
  return uv;
}

void ImageTerm::evaluate(const Pose& q, Eigen::Ref<Eigen::VectorXd> r, RowsJacobian* J) {
  fk_.update(skeleton_, q);
  ImageJacobian J_uv;
  Eigen::Index row = 0;
  for (const ImageTargets::Target& target : targets_.targets) {
    const double weight = target.weight / (scale_ * unit_m_);
    const BonePoint& point = points_[static_cast<std::size_t>(target.joint)];
    r.segment<2>(row) = weight * (project(point, q, J == nullptr ? nullptr : &J_uv) - target.uv);
    if (J != nullptr) J->middleRows<2>(row) = weight * J_uv;
    row += 2;
  }
}

double ImageTerm::rms(const Pose& q) {
  fk_.update(skeleton_, q);
  double sum = 0;
  for (const ImageTargets::Target& target : targets_.targets) {
    sum += (project(points_[static_cast<std::size_t>(target.joint)], q, nullptr) - target.uv).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(targets_.targets.size())) / scale_;
}

ImageStarts imageStarts(const Skeleton& skeleton, const ImageProjection& projection, const ImageTargets& targets,
                        const std::vector<PoseShape>& shapes) {
  DMC_CHECK(targets.targets.size() >= kLeastImageTargets);
  const std::vector<Eigen::Vector2d> uv = upright(projection, targets);
  struct Candidate {
    Pose q;
    Placed place;
  };
  std::vector<Candidate> nearest;
  std::vector<Eigen::Vector2d> xy(uv.size());
  for (int h = 0; h < kHeadings; ++h) {
    Candidate best;
    for (const PoseShape& shape : shapes) {
      Pose q = clampedToLimits(withShape(Pose::Zero(), shape));
      q[kRootRy] = 2.0 * std::numbers::pi * h / kHeadings;
      const JointPositions joints = jointPositions(skeleton, q);
      for (std::size_t i = 0; i < xy.size(); ++i) {
        xy[i] = joints.col(static_cast<int>(targets.targets[i].joint)).head<2>();
      }
      const Placed place = placed(xy, uv, targets);
      if (place.scale > 0 && (!(best.place.scale > 0) || place.error_m < best.place.error_m)) best = {q, place};
    }
    if (best.place.scale > 0) nearest.push_back(best);
  }
  ImageStarts starts;
  if (nearest.empty()) return starts;
  std::stable_sort(nearest.begin(), nearest.end(),
                   [](const Candidate& a, const Candidate& b) { return a.place.error_m < b.place.error_m; });
  const bool is_pinhole = projection.kind == Projection::Pinhole;
  const double scale = nearest.front().place.scale;
  starts.scale = is_pinhole ? scale * projection.camera.fx : scale;
  for (Candidate& candidate : nearest) {
    const Placed& place = candidate.place;
    candidate.q.head<2>() = place.middle / place.scale;
    candidate.q[kRootTz] = is_pinhole ? -1.0 / place.scale : std::log(place.scale / scale);
    starts.poses.push_back(candidate.q);
  }
  return starts;
}

}  // namespace depthmocap

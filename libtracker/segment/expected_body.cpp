#include "libtracker/segment/expected_body.h"

#include <algorithm>
#include <limits>

#include "libtracker/core/stick_figure.h"

namespace depthmocap {
namespace {

// [m] How far from the line between two joints surface is explained: a thigh in trousers and the error of a pose.
constexpr float kLimb_m = 0.13F;

float distanceToLine(const Eigen::Vector3f& p, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  const Eigen::Vector3f along = to - from;
  const float square = along.squaredNorm();
  const float share = square > 0 ? std::clamp(along.dot(p - from) / square, 0.0F, 1.0F) : 0.0F;
  return (p - from - share * along).norm();
}

// [m] By the joint at which the line ends.
float reachOf(Joint end) {
  switch (end) {
    case Joint::Spine:
    case Joint::Neck:
    case Joint::Head:
    case Joint::LeftShoulder:
    case Joint::RightShoulder:
    case Joint::LeftHip:
    case Joint::RightHip:
      return ExpectedBody::kFarthest_m;
    default:
      return kLimb_m;
  }
}

}  // namespace

ExpectedBody::ExpectedBody(Identity who, const JointPositions& p_camera)
    : who_(who),
      joints_(p_camera.cast<float>()),
      low_(joints_.rowwise().minCoeff().array() - kFarthest_m),
      high_(joints_.rowwise().maxCoeff().array() + kFarthest_m) {}

bool ExpectedBody::isNear(const Eigen::Vector3f& p) const {
  return (p.array() >= low_.array()).all() && (p.array() <= high_.array()).all();
}

float ExpectedBody::distance(const Eigen::Vector3f& p) const {
  float least = std::numeric_limits<float>::max();
  if (!isNear(p)) return least;
  for (const BoneLine& line : kBoneLines) {
    least = std::min(
        least, distanceToLine(p, joints_.col(static_cast<int>(line.from)), joints_.col(static_cast<int>(line.to))));
  }
  return least;
}

bool ExpectedBody::explains(const Eigen::Vector3f& p) const {
  return isNear(p) && std::ranges::any_of(kBoneLines, [&](const BoneLine& line) {
           return distanceToLine(p, joints_.col(static_cast<int>(line.from)), joints_.col(static_cast<int>(line.to))) <
                  reachOf(line.to);
         });
}

}  // namespace depthmocap

#include "libtracker/repair/up_direction.h"

#include <array>

namespace depthmocap {
namespace {

// Mean of the unit vectors upwards: shorter where the body lies or turns over.
constexpr double kClearMean = 0.6;

enum class Height { Low, Middle, High, None };

Height heightOf(Bone bone) {
  switch (bone) {
    case Bone::RightTibia:
    case Bone::LeftTibia:
    case Bone::RightFoot:
    case Bone::LeftFoot:
      return Height::Low;
    case Bone::Root:
    case Bone::RightFemur:
    case Bone::LeftFemur:
      return Height::Middle;
    case Bone::UpperBack:
    case Bone::RightClavicle:
    case Bone::LeftClavicle:
    case Bone::Neck:
    case Bone::Head:
      return Height::High;
    default:
      return Height::None;  // arms may be anywhere
  }
}

// From low markers to high ones; 0 where too little is seen.
Eigen::Vector3d upwards(const MarkerSequence& markers, const MarkerBody& body, Eigen::Index t) {
  std::array<Eigen::Vector3d, 3> sum = {Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
  std::array<int, 3> count{};
  for (const MarkerBody::Marker& marker : body.markers) {
    const Height height = heightOf(marker.site.bone);
    const MarkerTrack& track = markers.tracks[marker.track];
    if (height == Height::None || !track.seen[t]) continue;
    sum[static_cast<std::size_t>(height)] += track.p.col(t);
    ++count[static_cast<std::size_t>(height)];
  }
  const std::size_t low = count[0] > 0 ? 0 : 1;
  const std::size_t high = count[2] > 0 ? 2 : 1;
  if (low >= high || count[low] == 0 || count[high] == 0) return Eigen::Vector3d::Zero();
  return (sum[high] / count[high] - sum[low] / count[low]).normalized();
}

Eigen::Matrix3d rotationFor(UpAxis up) {
  Eigen::Matrix3d R;
  switch (up) {
    case UpAxis::PlusX:
      R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
      return R;
    case UpAxis::MinusX:
      R << 0, 1, 0, -1, 0, 0, 0, 0, 1;
      return R;
    case UpAxis::PlusY:
      return Eigen::Matrix3d::Identity();
    case UpAxis::MinusY:
      return Eigen::Vector3d(1, -1, -1).asDiagonal();
    case UpAxis::PlusZ:
      R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
      return R;
    case UpAxis::MinusZ:
      break;
  }
  R << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return R;
}

}  // namespace

Eigen::Matrix3d worldFromFile(const MarkerSequence& markers, const MarkerBody& body, const RepairConfig& config) {
  if (config.up) return rotationFor(*config.up);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  int count = 0;
  for (Eigen::Index t = 0; t < static_cast<Eigen::Index>(markers.frames()); ++t) {
    const Eigen::Vector3d up = upwards(markers, body, t);
    mean += up;
    count += up.isZero(0) ? 0 : 1;
  }
  if (count > 0) mean /= count;
  Eigen::Index axis = 0;
  if (mean.cwiseAbs().maxCoeff(&axis) < kClearMean) return rotationFor(config.usual_up);
  return rotationFor(static_cast<UpAxis>(2 * axis + (mean[axis] > 0 ? 0 : 1)));
}

}  // namespace depthmocap

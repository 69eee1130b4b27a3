#include "calibration/pose_cost.h"

#include <cmath>

namespace depthmocap {
namespace {

// Expected distance of a seen marker from that of the body [m]; chosen by hand.
constexpr double kMarkerDeviation_m = 0.025;
// Expected distance of the depth points from the surface [m]; the term is ours.
constexpr double kSurfaceDeviation_m = 0.012;
// Expected distance of the boundary between two parts from its plane on the body [m]; the term is ours.
constexpr double kBoundaryDeviation_m = 0.012;
// The same of the lower end of the torso, which no joint marks [m].
constexpr double kWaistDeviation_m = 0.025;
// Expected distance of the outline from crown, hands and feet [m]; the term is ours.
constexpr double kEndDeviation_m = 0.008;

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// A boundary's place on the skeleton: rigid with a bone and linear in the bone lengths.
struct BoundaryPlace {
  Bone bone = Bone::Root;
  ShapeJacobian place = ShapeJacobian::Zero();  // p_bone = place * shape
};

BoundaryPlace boundaryPlace(PartBoundary::Place which) {
  // The regions of the parts are defined by these planes (body/part_regions.h).
  constexpr double kShoulderShare = 0.25;  // of the upper arm
  constexpr double kWaistShare = 0.60;     // of the spine
  constexpr int kUpperArmColumn = 0;
  constexpr int kSpineColumn = 9;
  BoundaryPlace at;
  switch (which) {
    case PartBoundary::Place::LeftElbow:
      at.bone = Bone::LeftRadius;
      break;
    case PartBoundary::Place::RightElbow:
      at.bone = Bone::RightRadius;
      break;
    case PartBoundary::Place::LeftArm:
      at.bone = Bone::LeftHumerus;
      at.place(0, kUpperArmColumn) = kShoulderShare;
      break;
    case PartBoundary::Place::RightArm:
      at.bone = Bone::RightHumerus;
      at.place(0, kUpperArmColumn) = -kShoulderShare;
      break;
    case PartBoundary::Place::LeftKnee:
      at.bone = Bone::LeftTibia;
      break;
    case PartBoundary::Place::RightKnee:
      at.bone = Bone::RightTibia;
      break;
    case PartBoundary::Place::Waist:
      at.bone = Bone::Root;
      at.place(1, kSpineColumn) = kWaistShare;
      break;
  }
  return at;
}

}  // namespace

// The present values and where the next rows go.
struct PoseCost::Evaluation {
  Evaluation(double const* const* parameters, double* r, double** jacobians, int rows)
      : shape(Eigen::Map<const ShapeVector>(parameters[0])),
        offsets(Eigen::Map<const OffsetVector>(parameters[1])),
        q(Eigen::Map<const Pose>(parameters[2])),
        residuals(r, rows) {
    fk.update(makeSkeleton(boneLengths(shape)), q);
    kinematics.update(fk);
    if (jacobians == nullptr) return;
    constexpr std::array<int, 3> kColumns = {kShapeCount, kOffsetCount, kDofCount};
    for (std::size_t i = 0; i < 3; ++i) {
      if (jacobians[i] == nullptr) continue;
      new (&J[i]) Eigen::Map<RowMajor>(jacobians[i], rows, kColumns[i]);
      J[i].setZero();
    }
  }
  [[nodiscard]] bool wants(std::size_t block) const { return J[block].data() != nullptr; }

  // Adds the row `scale * (direction . p - offset)` of a point rigid with a bone whose place changes with the shape.
  void addRow(Bone bone, const Eigen::Vector3d& p_bone, const ShapeJacobian& place, const Eigen::Vector3d& direction,
              double offset, double scale) {
    const BonePoint point{bone, p_bone};
    residuals[row] = scale * (direction.dot(fk.position(point)) - offset);
    if (wants(0)) J[0].row(row) = scale * direction.transpose() * kinematics.jacobian(fk, bone, place);
    if (wants(2)) {
      fk.jacobian(point, J_q);
      J[2].row(row) = scale * direction.transpose() * J_q;
    }
    ++row;
  }

  const ShapeVector shape;
  const OffsetVector offsets;
  const Pose q;
  ForwardKinematics fk;
  ShapeKinematics kinematics;
  PointJacobian J_q;
  Eigen::Map<Eigen::VectorXd> residuals;
  std::array<Eigen::Map<RowMajor>, 3> J{Eigen::Map<RowMajor>(nullptr, 0, 0), Eigen::Map<RowMajor>(nullptr, 0, 0),
                                        Eigen::Map<RowMajor>(nullptr, 0, 0)};
  int row = 0;
};

PoseCost::PoseCost(const BodyTemplate& body, const PoseObservation& observation, const Matches& matches,
                   const std::array<Bone, kPartCount>& marker_bones, const JointSolveConfig& config)
    : body_(body), observation_(observation), matches_(matches), marker_bones_(marker_bones), config_(config) {
  mutable_parameter_block_sizes()->assign({kShapeCount, kOffsetCount, kDofCount});
  set_num_residuals(static_cast<int>(kOffsetCount + matches.cloud.size() + observation.boundaries.size() +
                                     matches.ends.size() + kDofCount));
}

bool PoseCost::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  Evaluation e(parameters, residuals, jacobians, num_residuals());
  evaluateMarkers(e);
  evaluateCloud(e);
  evaluateBoundaries(e);
  evaluateEnds(e);
  evaluatePose(e);
  return true;
}

void PoseCost::evaluateMarkers(Evaluation& e) const {
  for (int part = 0; part < kPartCount; ++part) {
    const double scale =
        std::sqrt(observation_.weight * observation_.markers_world.confidence[part]) / kMarkerDeviation_m;
    const Bone bone = marker_bones_[static_cast<std::size_t>(part)];
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d direction = Eigen::Vector3d::Unit(axis);
      if (e.wants(1)) {
        e.J[1].row(e.row).segment<3>(3 * part) = scale * direction.transpose() * e.fk.R_world_bone(bone);
      }
      e.addRow(bone, e.offsets.segment<3>(3 * part), ShapeJacobian::Zero(), direction,
               observation_.markers_world.position(axis, part), scale);
    }
  }
}

void PoseCost::evaluateCloud(Evaluation& e) const {
  if (matches_.cloud.empty()) return;
  const double share = config_.surface_points / static_cast<double>(matches_.cloud.size());
  for (const CloudMatch& match : matches_.cloud) {
    const double scale = std::sqrt(observation_.weight * share * match.weight) / kSurfaceDeviation_m;
    e.addRow(match.model->bone, body_.place(*match.model, e.shape), body_.placeJacobian(*match.model), match.n_world,
             match.n_world.dot(match.p_world), scale);
  }
}

void PoseCost::evaluateBoundaries(Evaluation& e) const {
  for (const PartBoundary& boundary : observation_.boundaries) {
    const bool is_waist = boundary.place == PartBoundary::Place::Waist;
    const double deviation = is_waist ? kWaistDeviation_m : kBoundaryDeviation_m;
    const double scale = std::sqrt(observation_.weight) / deviation;
    const BoundaryPlace at = boundaryPlace(boundary.place);
    e.addRow(at.bone, at.place * e.shape, at.place, boundary.direction, boundary.offset, scale);
  }
}

void PoseCost::evaluateEnds(Evaluation& e) const {
  const double scale = std::sqrt(observation_.weight) / kEndDeviation_m;
  for (const EndMatch& end : matches_.ends) {
    e.addRow(end.model.bone, body_.place(end.model, e.shape), body_.placeJacobian(end.model), end.direction, end.offset,
             scale);
  }
}

void PoseCost::evaluatePose(Evaluation& e) const {
  for (int i = 0; i < kDofCount; ++i, ++e.row) {
    const double deviation = observation_.deviation[i];
    const double scale = deviation > 0 ? std::sqrt(observation_.weight) / deviation : 0.0;
    e.residuals[e.row] = scale * (e.q[i] - observation_.q[i]);
    if (e.wants(2)) e.J[2](e.row, i) = scale;
  }
}

}  // namespace depthmocap

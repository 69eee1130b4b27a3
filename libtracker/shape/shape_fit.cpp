#include "libtracker/shape/shape_fit.h"

#include <Eigen/Cholesky>

namespace depthmocap {
namespace {

// What people of one stature differ by, as shares; chosen by five motions, see docs/tuning.md.
constexpr double kLengthDeviation = 0.035;
constexpr double kGirthDeviation = 0.12;
constexpr double kStatureDeviation = 0.03;  // of the stature that the picture's height tells

// The matches of one frame count as this many independent points of this deviation: few, because clothes and whatever
// else the template lacks are wrong in all of them alike.
constexpr double kPointsOfFrame = 4;
constexpr double kPointDeviation_m = 0.010;
// Frames resemble each other, and what is wrong in one is wrong in the next: all of them count as no more than this
// many, the newest most.
constexpr double kMostFrames = 60;

// Outlines against depth, beyond what they count in the pose: depth near outlines is smoothed, so that by itself it
// makes limbs ever thicker (girths of 1.3 to 1.4 times the true ones with the noise of Kinect v1, right without).
constexpr double kOutlineWorth = 20;

// Nobody is believed to differ by more from what is typical, whatever the frames say.
constexpr double kLeastOfTypical = 0.6;
constexpr double kMostOfTypical = 1.6;

constexpr double kLeastCurvature = 1e-6;  // of a DoF that nothing holds

using ShapePose = Eigen::Matrix<double, kShapeCount, kDofCount>;

ShapeMatrix typicalInformation(const ShapeVector& typical) {
  ShapeVector deviation = typical;
  deviation.head<kBoneLengthCount>() *= kLengthDeviation;
  deviation.tail<kGirthCount>() *= kGirthDeviation;
  ShapeMatrix covariance = deviation.cwiseAbs2().asDiagonal();
  covariance += kStatureDeviation * kStatureDeviation * typical * typical.transpose();
  return covariance.inverse();
}

// Sums over matches: how squared distances change with shape, with both, with the pose.
struct Sums {
  ShapeMatrix A = ShapeMatrix::Zero();
  ShapePose B = ShapePose::Zero();
  ShapeVector g = ShapeVector::Zero();
  double total = 0;

  Sums(const ShapeVector& s, const ForwardKinematics& f) : shape(s), fk(f) { kinematics.update(fk); }

  // Returns d (n . p) / d q.
  Pose add(const SurfaceMatch& match, double k) {
    const Eigen::RowVector3d n = match.n_world.transpose();
    const ShapeJacobian place = BodyTemplate::average().placeJacobian(match.model, match.part, shape);
    const ShapeVector a = (n * kinematics.jacobian(fk, match.model.bone, place)).transpose();
    fk.jacobian(match.model, J_q);
    Pose row = (n * J_q).transpose();
    A.selfadjointView<Eigen::Lower>().rankUpdate(a, k);
    B.noalias() += (k * a) * row.transpose();
    g += k * off(match) * a;
    total += k;
    return row;
  }
  [[nodiscard]] double off(const SurfaceMatch& match) const {
    return match.n_world.dot(fk.position(match.model) - match.p_world);
  }

  const ShapeVector& shape;
  const ForwardKinematics& fk;
  ShapeKinematics kinematics;
  PointJacobian J_q;
};

}  // namespace

ShapeEvidence shapeEvidence(const ShapeVector& shape, const ForwardKinematics& fk, const ShapeMatches& matches,
                            double scale, NormalEquations pose) {
  Sums sums(shape, fk);
  for (const SurfaceMatch& match : matches.measured) sums.add(match, scale * match.weight);
  for (const SurfaceMatch& match : matches.outline) {
    const double k = scale * match.weight;
    const Pose row = sums.add(match, kOutlineWorth * k);
    pose.A.selfadjointView<Eigen::Lower>().rankUpdate(row, (kOutlineWorth - 1.0) * k);
    pose.g += (kOutlineWorth - 1.0) * k * sums.off(match) * row;
  }
  ShapeEvidence evidence;
  if (sums.total <= 0) return evidence;
  // The pose takes the value that suits each shape best: Schur's complement.
  pose.A.diagonal().array() += kLeastCurvature;
  const Eigen::LDLT<PoseMatrix, Eigen::Lower> ldlt(pose.A);
  const Eigen::Matrix<double, kDofCount, kShapeCount> follow = ldlt.solve(sums.B.transpose());
  const double worth = kPointsOfFrame / (kPointDeviation_m * kPointDeviation_m * sums.total);
  evidence.A = sums.A.selfadjointView<Eigen::Lower>();
  evidence.A = worth * (evidence.A - sums.B * follow);
  evidence.b = evidence.A * shape - worth * (sums.g - follow.transpose() * pose.g);
  return evidence;
}

ShapeVector ShapeFit::typical(double stature_m) {
  return shapeVector(averageBoneLengths(stature_m), BodyTemplate::average().girthOf(stature_m));
}

void ShapeFit::observe(const ShapeEvidence& frame) {
  constexpr double kKept = 1.0 - 1.0 / kMostFrames;
  sum_.A = kKept * sum_.A + frame.A;
  sum_.b = kKept * sum_.b + frame.b;
  ++frames_;
}

ShapeVector ShapeFit::best(double stature_m) const {
  const ShapeVector mean = typical(stature_m);
  const ShapeMatrix prior = typicalInformation(mean);
  ShapeVector found = Eigen::LDLT<ShapeMatrix>(sum_.A + prior).solve(sum_.b + prior * mean);
  if (!found.allFinite()) found = mean;
  return found.cwiseMax(kLeastOfTypical * mean).cwiseMin(kMostOfTypical * mean);
}

ShapeVector ShapeFit::deviation(double stature_m) const {
  return (sum_.A + typicalInformation(typical(stature_m))).inverse().diagonal().cwiseSqrt();
}

}  // namespace depthmocap

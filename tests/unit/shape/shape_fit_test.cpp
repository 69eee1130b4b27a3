#include "libtracker/shape/shape_fit.h"

#include <Eigen/Cholesky>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr double kStature_m = 1.75;
constexpr double kScale = 1000;  // [1/m^2] of a match of weight 1

ShapeVector unusualShape() {
  ShapeVector shape = ShapeFit::typical(kStature_m);
  shape[0] *= 1.05;  // upper arm
  shape[3] *= 0.96;  // lower leg
  shape[kBoneLengthCount + static_cast<int>(Girth::TorsoDepth)] *= 1.2;
  shape[kBoneLengthCount + static_cast<int>(Girth::UpperLeg)] *= 0.88;
  return shape;
}

Pose somePose(std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, 0.25);
  Pose q;
  for (int i = 0; i < kDofCount; ++i) q[i] = normal(random);
  q[kRootTz] = -3.0;
  return q;
}

// Every tenth point of the surface of `model` against the same point of `seen`, both in one pose.
SurfaceMatches matchesOf(const ShapeVector& model, const ShapeVector& seen, const Pose& q,
                         const Eigen::Vector3d& moved) {
  const BodyTemplate& body = BodyTemplate::average();
  ForwardKinematics fk;
  ForwardKinematics fk_seen;
  fk.update(makeSkeleton(boneLengths(model)), q);
  fk_seen.update(makeSkeleton(boneLengths(seen)), q);
  SurfaceMatches matches;
  for (std::size_t i = 0; i < body.points().size(); i += 10) {
    const BodyTemplate::Point& point = body.points()[i];
    SurfaceMatch match;
    match.model = {point.bone, body.place(point, model)};
    match.part = point.part;
    match.p_world = fk_seen.position({point.bone, body.place(point, seen)}) + moved;
    match.n_world = fk.R_world_bone(point.bone) * body.normal(point, model);
    match.weight = 1;
    matches.push_back(match);
  }
  return matches;
}

// What these matches, and next to nothing else, say of the pose.
NormalEquations poseEvidence(const ForwardKinematics& fk, const SurfaceMatches& matches) {
  NormalEquations evidence;
  PointJacobian J;
  for (const SurfaceMatch& match : matches) {
    fk.jacobian(match.model, J);
    const Pose row = (match.n_world.transpose() * J).transpose();
    evidence.A += kScale * row * row.transpose();
    evidence.g += kScale * match.n_world.dot(fk.position(match.model) - match.p_world) * row;
  }
  evidence.A.diagonal().array() += 1.0;
  return evidence;
}

ShapeEvidence frameOf(const ShapeVector& model, const ShapeVector& seen, const Pose& q,
                      const Eigen::Vector3d& moved = Eigen::Vector3d::Zero()) {
  ForwardKinematics fk;
  fk.update(makeSkeleton(boneLengths(model)), q);
  const SurfaceMatches matches = matchesOf(model, seen, q, moved);
  return shapeEvidence(model, fk, {matches, {}}, kScale, poseEvidence(fk, matches));
}

TEST(ShapeFit, FindsTheShapeFromFramesOfManyPoses) {
  std::mt19937 random(1);
  const ShapeVector truth = unusualShape();
  ShapeFit fit;
  ShapeVector shape = ShapeFit::typical(kStature_m);
  for (int frame = 0; frame < 30; ++frame) {
    fit.observe(frameOf(shape, truth, somePose(random)));
    shape = fit.best(kStature_m);
  }
  const ShapeVector off = shape - truth;
  EXPECT_LT(off.head<kBoneLengthCount>().cwiseAbs().maxCoeff(), 0.016);
  EXPECT_LT(off.tail<kGirthCount>().cwiseAbs().maxCoeff(), 0.03);
  const double before = (ShapeFit::typical(kStature_m) - truth).norm();
  EXPECT_LT(off.norm(), 0.2 * before);
}

TEST(ShapeFit, WithoutFramesIsWhatIsTypical) {
  const ShapeFit fit;
  EXPECT_EQ(fit.frames(), 0);
  EXPECT_TRUE(fit.best(1.6).isApprox(ShapeFit::typical(1.6), 1e-9));
  EXPECT_NEAR(statureOf(boneLengths(ShapeFit::typical(1.6))), 1.6, 1e-9);
}

TEST(ShapeFit, BelievesNoBodyThatNobodyHas) {
  ShapeFit fit;
  ShapeEvidence wrong;
  wrong.A.diagonal().setConstant(1e9);
  wrong.b = wrong.A * (10.0 * ShapeFit::typical(kStature_m));
  fit.observe(wrong);
  EXPECT_TRUE(fit.best(kStature_m).isApprox(1.6 * ShapeFit::typical(kStature_m), 1e-6));
  wrong.b.setConstant(std::numeric_limits<double>::quiet_NaN());
  fit.observe(wrong);
  EXPECT_TRUE(fit.best(kStature_m).isApprox(ShapeFit::typical(kStature_m), 1e-6));
}

TEST(ShapeFit, FramesMakeEntriesSurer) {
  std::mt19937 random(2);
  ShapeFit fit;
  const ShapeVector before = fit.deviation(kStature_m);
  const ShapeVector typical = ShapeFit::typical(kStature_m);
  for (int frame = 0; frame < 5; ++frame) fit.observe(frameOf(typical, typical, somePose(random)));
  EXPECT_TRUE((fit.deviation(kStature_m).array() <= before.array() * (1 + 1e-9)).all());
  const auto upper_leg = kBoneLengthCount + static_cast<int>(Girth::UpperLeg);
  EXPECT_LT(fit.deviation(kStature_m)[upper_leg], 0.6 * before[upper_leg]);
}

TEST(ShapeEvidence, SaysNothingOfTheShapeWhereTheBodyWasMoved) {
  std::mt19937 random(3);
  const ShapeVector shape = ShapeFit::typical(kStature_m);
  const Pose q = somePose(random);
  const ShapeEvidence still = frameOf(shape, shape, q);
  const ShapeEvidence moved = frameOf(shape, shape, q, {0.02, -0.01, 0.03});
  EXPECT_TRUE(still.A.isApprox(moved.A, 1e-9));
  // As sure of the same shape: what is left of the shift is the weak hold on the pose.
  EXPECT_LT((moved.b - still.b).norm(), 1e-3 * still.b.norm());
}

// What the shape alone changes by, the pose following: against differences of the points' places over shape and pose.
TEST(ShapeEvidence, LeavesToThePoseWhatThePoseCanExplain) {
  std::mt19937 random(4);
  const ShapeVector shape = ShapeFit::typical(kStature_m);
  const Pose q = somePose(random);
  ForwardKinematics fk;
  fk.update(makeSkeleton(boneLengths(shape)), q);
  const SurfaceMatches matches = matchesOf(shape, shape, q, Eigen::Vector3d::Zero());
  const auto rows = static_cast<Eigen::Index>(matches.size());
  Eigen::MatrixXd J(rows, kShapeCount + kDofCount);
  constexpr double kStep = 1e-5;
  for (Eigen::Index c = 0; c < J.cols(); ++c) {
    ShapeVector shape_c = shape;
    Pose q_c = q;
    (c < kShapeCount ? shape_c[c] : q_c[c - kShapeCount]) += kStep;
    const SurfaceMatches moved = matchesOf(shape, shape_c, q_c, Eigen::Vector3d::Zero());
    for (Eigen::Index r = 0; r < rows; ++r) {
      const auto i = static_cast<std::size_t>(r);
      J(r, c) = matches[i].n_world.dot(moved[i].p_world - matches[i].p_world) / kStep;
    }
  }
  const Eigen::MatrixXd H = kScale * J.transpose() * J;
  const Eigen::MatrixXd H_qs = H.bottomLeftCorner<kDofCount, kShapeCount>();
  const Eigen::MatrixXd H_qq = H.bottomRightCorner<kDofCount, kDofCount>() + PoseMatrix::Identity();
  const ShapeMatrix expected = H.topLeftCorner<kShapeCount, kShapeCount>() - H_qs.transpose() * H_qq.ldlt().solve(H_qs);
  const ShapeMatrix found = shapeEvidence(shape, fk, {matches, {}}, kScale, poseEvidence(fk, matches)).A;
  EXPECT_TRUE((found / found.trace()).isApprox(expected / expected.trace(), 1e-3));
}

TEST(ShapeEvidence, OfNoMatchesIsNothing) {
  ForwardKinematics fk;
  const ShapeVector shape = ShapeFit::typical(kStature_m);
  fk.update(makeSkeleton(boneLengths(shape)), Pose::Zero());
  const ShapeEvidence none = shapeEvidence(shape, fk, ShapeMatches{}, kScale, NormalEquations{});
  EXPECT_TRUE(none.A.isZero() && none.b.isZero());
}

TEST(ShapeEvidence, JacobianOfAPlacedPointIsThatOfTheTemplates) {
  const BodyTemplate& body = BodyTemplate::average();
  const ShapeVector shape = unusualShape();
  for (std::size_t i = 0; i < body.points().size(); i += 50) {
    const BodyTemplate::Point& point = body.points()[i];
    const ShapeJacobian placed = body.placeJacobian({point.bone, body.place(point, shape)}, point.part, shape);
    EXPECT_TRUE(placed.isApprox(body.placeJacobian(point), 1e-9)) << i;
  }
}

}  // namespace
}  // namespace depthmocap

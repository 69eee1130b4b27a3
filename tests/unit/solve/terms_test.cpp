#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "libtracker/solve/limit_term.h"
#include "libtracker/solve/marker_term.h"
#include "libtracker/solve/prior_term.h"
#include "libtracker/solve/smooth_term.h"
#include "tests/moving_body.h"
#include "tests/unit/solve/term_check.h"

namespace depthmocap {
namespace {

const Skeleton kBody = makeSkeleton(BoneLengths{});

double lorentzian(double e, double sigma) {
  return std::log(1.0 + e * e / (2.0 * sigma * sigma));
}

TEST(MarkerTerm, GradientMatchesNearAndFarFromTheMarkers) {
  const MovingBody scene;
  Random random(1);
  const Pose truth = MovingBody::motion(1, 0.3);
  for (const double noise_m : {1e-4, 0.01, 0.05, 0.4}) {
    const MarkerSet markers = scene.noisyMarkers(truth, noise_m, 3, random);
    const MarkerTerm term(scene.model, markers, 5.0, 0.05);
    expectGradientMatches(term, kBody, truth, 1e-5);
    expectGradientMatches(term, kBody, MovingBody::motion(1, 0.5), 1e-5);
  }
}

TEST(MarkerTerm, GradientIsFiniteAtAPerfectFit) {
  const MovingBody scene;
  const Pose truth = MovingBody::motion(2, 0.1);
  const MarkerSet markers = scene.markers(truth);
  const MarkerTerm term(scene.model, markers, 5.0, 0.05);
  EXPECT_LT(energyOf(term, kBody, truth), 1e-12);
  expectGradientMatches(term, kBody, truth, 1e-6);
}

TEST(MarkerTerm, EnergyIsTheWeightedLorentzianOfTheSeenMarkers) {
  const MovingBody scene;
  const Pose q = MovingBody::motion(3, 0.0);
  MarkerSet markers = scene.markers(q);
  markers.position.col(2).x() += 0.03;
  markers.position.col(9).y() += 0.7;
  markers.position.col(11).z() += 1e-6;
  markers.position.col(4).setConstant(1e6);
  markers.confidence[4] = 0;
  markers.confidence[9] = 0.25;
  const MarkerTerm term(scene.model, markers, 5.0, 0.05);
  const double expected = 5.0 * (lorentzian(0.03, 0.05) + 0.25 * lorentzian(0.7, 0.05) + lorentzian(1e-6, 0.05));
  EXPECT_NEAR(energyOf(term, kBody, q), expected, 1e-10);
  EXPECT_NEAR(term.rms(framesOf(scene.skeleton, q)), std::sqrt((0.03 * 0.03 + 0.25 * 0.49) / 13.25), 1e-9);
}

// The quadratic model must be that of iteratively reweighted least squares.
TEST(MarkerTerm, CurvatureIsThatOfReweightedLeastSquares) {
  const MovingBody scene;
  const Pose q = MovingBody::motion(3, 0.0);
  for (const double e : {1e-7, 0.01, 0.05, 0.2, 1.0}) {
    MarkerSet markers = scene.markers(q);
    markers.confidence.setZero();
    markers.confidence[0] = 0.5;
    markers.position(0, 0) += e;
    const MarkerTerm term(scene.model, markers, 5.0, 0.05);
    const NormalEquations equations = equationsOf(term, scene.skeleton, q);
    const double slope = 2.5 / (2.0 * 0.05 * 0.05 + e * e);  // 2.5 rho'(e^2)
    EXPECT_NEAR(equations.A(kRootTx, kRootTx), slope, 1e-6 * slope);
    EXPECT_NEAR(equations.A(kRootTy, kRootTy), slope, 1e-6 * slope);
    EXPECT_NEAR(equations.g[kRootTx], -slope * e, 1e-6 * slope * e);
  }
}

TEST(MarkerTerm, NoMarkersNoEnergy) {
  const MovingBody scene;
  const MarkerSet none;
  const MarkerTerm term(scene.model, none, 5.0, 0.05);
  EXPECT_EQ(energyOf(term, kBody, Pose::Zero()), 0);
  EXPECT_EQ(term.rms(framesOf(scene.skeleton, Pose::Zero())), 0);
}

std::vector<Pose> somePoses() {
  std::vector<Pose> poses;
  for (int i = 0; i < 20; ++i) poses.push_back(MovingBody::motion(4, 0.1 * i));
  return poses;
}

TEST(PriorTerm, GradientMatches) {
  const LocalPrior prior = MovingBody::priorOf(somePoses(), 2);
  PriorTerm term(&prior, 0.2, 0);
  expectGradientMatches(term, kBody, MovingBody::motion(5, 0.2));
}

TEST(PriorTerm, IsZeroOnTheSubspaceAndTheSquaredDistanceOffIt) {
  const LocalPrior prior = MovingBody::priorOf(somePoses(), 3);
  PriorTerm term(&prior, 0.2, 0);
  Pose q = prior.mean + prior.basis.leftCols<3>() * Eigen::Vector3d(0.7, -0.4, 0.2);
  EXPECT_LT(energyOf(term, kBody, q), 1e-12);
  q.head<3>() << 3, -2, 1;  // where the actor stands does not matter
  q[kRootRy] = 2.5;
  EXPECT_LT(energyOf(term, kBody, q), 1e-12);
  Pose off = Pose::Zero();
  for (int dof : kShapeDofs) off[dof] = 0.01 * dof;
  off -= (prior.basis.leftCols<3>() * (prior.basis.leftCols<3>().transpose() * off)).eval();
  EXPECT_NEAR(energyOf(term, kBody, q + off), 0.2 * off.squaredNorm(), 1e-12);
}

TEST(PriorTerm, OfAGaussianIsTheMahalanobisDistance) {
  LocalPrior prior = MovingBody::priorOf(somePoses(), 3);
  prior.deviation.head<3>() << 0.5, 0.2, 0.01;
  prior.residual_rad = 0.05;
  PriorTerm term(&prior, 100.0, 0);
  expectGradientMatches(term, kBody, MovingBody::motion(5, 0.2));
  const auto P = prior.basis.leftCols<3>();
  Eigen::Matrix<double, kDofCount, kDofCount> covariance = 0.05 * 0.05 * Pose::Ones().asDiagonal().toDenseMatrix();
  covariance += P * prior.deviation.head<3>().cwiseAbs2().asDiagonal() * P.transpose();
  Pose d = Pose::Zero();
  for (int dof : kShapeDofs) d[dof] = 0.01 * (dof % 7) - 0.02;
  const double expected = 100.0 * 0.05 * 0.05 * d.dot(covariance.ldlt().solve(d));
  EXPECT_NEAR(energyOf(term, kBody, prior.mean + d), expected, 1e-9);
}

// The density of a multivariate Student distribution, and a Gaussian where it has many degrees of freedom.
TEST(PriorTerm, WithFreedomItIsAStudentDistribution) {
  LocalPrior prior = MovingBody::priorOf(somePoses(), 3);
  prior.deviation.head<3>() << 0.5, 0.2, 0.01;
  prior.residual_rad = 0.05;
  const Pose q = MovingBody::motion(5, 0.2);
  const double unit = 100.0 * 0.05 * 0.05;
  const double square = energyOf(PriorTerm(&prior, 100.0, 0), kBody, q) / unit;  // Mahalanobis
  const PriorTerm student(&prior, 100.0, 4.0);
  EXPECT_NEAR(energyOf(student, kBody, q), unit * (4.0 + kShapeDofCount) * std::log1p(square / 4.0), 1e-9);
  expectGradientMatches(student, kBody, q);
  EXPECT_NEAR(energyOf(PriorTerm(&prior, 100.0, 1e9), kBody, q), unit * square, 1e-4 * unit * square);
}

TEST(PriorTerm, NoPriorNoEnergy) {
  PriorTerm term(nullptr, 0.2, 5);
  EXPECT_EQ(energyOf(term, kBody, MovingBody::motion(5, 0.2)), 0);
}

TEST(SmoothTerm, GradientMatches) {
  const Pose q1 = MovingBody::motion(6, 0.1);
  const Pose q2 = MovingBody::motion(6, 0.05);
  SmoothTerm term(&q1, &q2, 1.0, 1.0);
  expectGradientMatches(term, kBody, MovingBody::motion(6, 0.2));
}

TEST(SmoothTerm, IsThePapersSecondDifference) {
  const Pose q = MovingBody::motion(6, 0.2);
  const Pose q1 = MovingBody::motion(6, 0.1);
  const Pose q2 = MovingBody::motion(6, 0.05);
  SmoothTerm term(&q1, &q2, 1.0, 3.0);
  EXPECT_NEAR(energyOf(term, kBody, q), 3.0 * (q - 2 * q1 + q2).squaredNorm(), 1e-12);
}

TEST(SmoothTerm, ConstantVelocityCostsNothingAtUnevenTimes) {
  const Pose q2 = MovingBody::motion(7, 0.0);
  const Pose velocity = MovingBody::motion(7, 0.5) - q2;
  const Pose q1 = q2 + 0.033 * velocity;
  SmoothTerm term(&q1, &q2, 3.0, 1.0);
  EXPECT_LT(energyOf(term, kBody, q1 + 0.099 * velocity), 1e-12);
}

TEST(SmoothTerm, HeadingGoesAroundTheCircle) {
  Pose q2 = Pose::Zero();
  Pose q1 = Pose::Zero();
  Pose q = Pose::Zero();
  q2[kRootRy] = 3.10;
  q1[kRootRy] = 3.13;
  q[kRootRy] = 3.16 - 2.0 * std::numbers::pi;
  SmoothTerm term(&q1, &q2, 1.0, 1.0);
  EXPECT_LT(energyOf(term, kBody, q), 1e-12);
  q1[kRootRy] -= 2.0 * std::numbers::pi;
  SmoothTerm across(&q1, &q2, 1.0, 1.0);
  EXPECT_LT(energyOf(across, kBody, q), 1e-12);
}

TEST(SmoothTerm, WithOnePoseNoMotionIsExpectedAndWithNoneNothing) {
  const Pose q1 = MovingBody::motion(8, 0.0);
  SmoothTerm one(&q1, nullptr, 1.0, 1.0);
  EXPECT_EQ(energyOf(one, kBody, q1), 0);
  EXPECT_NEAR(energyOf(one, kBody, Pose(q1.array() + 0.1)), 0.01 * kDofCount, 1e-12);
  SmoothTerm none(nullptr, nullptr, 1.0, 1.0);
  EXPECT_EQ(energyOf(none, kBody, q1), 0);
}

TEST(LimitTerm, GradientMatchesOnBothSidesAndWithin) {
  LimitTerm term(10.0);
  expectGradientMatches(term, kBody, jointLimits().upper.cwiseMin(3.0) + Pose::Constant(0.1));
  expectGradientMatches(term, kBody, jointLimits().lower.cwiseMax(-3.0) - Pose::Constant(0.1));
  expectGradientMatches(term, kBody, Pose::Zero());
}

TEST(LimitTerm, CostsTheSquaredExcessOnly) {
  LimitTerm term(10.0);
  Pose q = MovingBody::motion(9, 0.3);
  q[kRootRy] = 100;
  q[kRootTx] = -40;
  EXPECT_EQ(energyOf(term, kBody, clampedToLimits(q)), 0);
  q = clampedToLimits(q);
  q[kRtibiaRx] = jointLimits().lower[kRtibiaRx] - 0.3;
  q[kLradiusRy] = jointLimits().upper[kLradiusRy] + 0.1;
  EXPECT_NEAR(energyOf(term, kBody, q), 10.0 * (0.09 + 0.01), 1e-12);
}

TEST(WrappedAngle, StaysInTheHalfOpenRange) {
  EXPECT_NEAR(wrappedAngle(7.0), 7.0 - 2 * std::numbers::pi, 1e-12);
  EXPECT_DOUBLE_EQ(wrappedAngle(-std::numbers::pi), std::numbers::pi);
  EXPECT_DOUBLE_EQ(wrappedAngle(std::numbers::pi), std::numbers::pi);
  EXPECT_DOUBLE_EQ(wrappedAngle(-0.5), -0.5);
}

}  // namespace
}  // namespace depthmocap

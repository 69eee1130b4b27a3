#include "libtracker/posedb/best_rotation.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d randomVector(Random& random) {
  return {random.normal(), random.normal(), random.normal()};
}

Matrix3d randomRotation(Random& random) {
  return Eigen::AngleAxisd(random.uniform(-3.14, 3.14), randomVector(random).normalized()).toRotationMatrix();
}

Matrix3d randomMatrix(Random& random) {
  Matrix3d S;
  for (int i = 0; i < 3; ++i) S.col(i) = randomVector(random);
  return S;
}

double gain(const Matrix3d& R, const Matrix3d& S) {
  return (R.transpose() * S).trace();
}

// Kabsch: the plain sibling.
double bestGainBySvd(const Matrix3d& S) {
  const Eigen::JacobiSVD<Matrix3d> svd(S, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3d D = Matrix3d::Identity();
  D(2, 2) = svd.matrixU().determinant() * svd.matrixV().determinant();
  return gain(svd.matrixU() * D * svd.matrixV().transpose(), S);
}

void expectRotation(const Matrix3d& R) {
  EXPECT_LT((R * R.transpose() - Matrix3d::Identity()).norm(), 1e-9);
  EXPECT_NEAR(R.determinant(), 1.0, 1e-9);
}

TEST(BestRotation, RecoversTheRotationBetweenPointSets) {
  Random random(1);
  for (int repeat = 0; repeat < 50; ++repeat) {
    const Matrix3d truth = randomRotation(random);
    Matrix3d S = Matrix3d::Zero();
    for (int i = 0; i < 6; ++i) {
      const Vector3d b = randomVector(random);
      S += truth * b * b.transpose();
    }
    EXPECT_LT((bestRotation(S) - truth).norm(), 1e-7);
  }
}

TEST(BestRotation, GainsAsMuchAsTheSingularValueDecomposition) {
  Random random(2);
  for (int repeat = 0; repeat < 200; ++repeat) {
    const Matrix3d S = randomMatrix(random) * std::pow(10.0, random.uniform(-4, 2));
    const Matrix3d R = bestRotation(S);
    expectRotation(R);
    EXPECT_NEAR(gain(R, S), bestGainBySvd(S), 1e-7 * S.norm());
  }
}

TEST(BestRotation, BearsPointsInAPlaneInALineAndNone) {
  Random random(3);
  const Vector3d a = randomVector(random);
  const Vector3d b = randomVector(random);
  const Matrix3d line = a * b.transpose();
  const Matrix3d plane = line + randomVector(random) * randomVector(random).transpose();
  for (const Matrix3d& S :
       {line, plane, Matrix3d(Matrix3d::Zero()), Matrix3d(Matrix3d::Identity()), Matrix3d(-Matrix3d::Identity())}) {
    const Matrix3d R = bestRotation(S);
    expectRotation(R);
    EXPECT_NEAR(gain(R, S), bestGainBySvd(S), 1e-6 * S.norm() + 1e-12);
  }
}

TEST(BestRotationAboutY, NoOtherAngleGainsMore) {
  Random random(4);
  for (int repeat = 0; repeat < 20; ++repeat) {
    const Matrix3d S = randomMatrix(random);
    const Matrix3d R = bestRotationAboutY(S);
    expectRotation(R);
    EXPECT_LT((R * Vector3d::UnitY() - Vector3d::UnitY()).norm(), 1e-12);
    for (double angle = -3.1; angle < 3.14; angle += 0.1) {
      EXPECT_LE(gain(Eigen::AngleAxisd(angle, Vector3d::UnitY()).toRotationMatrix(), S), gain(R, S) + 1e-12);
    }
  }
  expectRotation(bestRotationAboutY(Matrix3d::Zero()));
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/posedb/best_rotation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

namespace depthmocap {
namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector4d;

// Davenport's matrix for quaternions (w, x, y, z), R b ~ a.
Matrix4d davenportMatrix(const Matrix3d& S) {
  // z_i = components of sum w b x a.
  const double zx = S(2, 1) - S(1, 2);
  const double zy = S(0, 2) - S(2, 0);
  const double zz = S(1, 0) - S(0, 1);
  const double xy = S(0, 1) + S(1, 0);
  const double xz = S(0, 2) + S(2, 0);
  const double yz = S(1, 2) + S(2, 1);
  Matrix4d K;
  K << S(0, 0) + S(1, 1) + S(2, 2), zx, zy, zz,  //
      zx, S(0, 0) - S(1, 1) - S(2, 2), xy, xz,   //
      zy, xy, S(1, 1) - S(0, 0) - S(2, 2), yz,   //
      zz, xz, yz, S(2, 2) - S(0, 0) - S(1, 1);
  return K;
}

// The largest root of det(K - l I) = l^4 + c2 l^2 + c1 l + c0, from above, where Newton's iteration falls
// monotonically.
double largestEigenvalue(const Matrix4d& K, const Matrix3d& S) {
  constexpr int kMostSteps = 50;
  const double c2 = -2.0 * S.squaredNorm();
  const double c1 = -8.0 * S.determinant();
  const double c0 = K.determinant();
  double l = std::sqrt(3.0) * S.norm();  // trace(R^T S) <= |R| |S|
  for (int step = 0; step < kMostSteps; ++step) {
    const double value = ((l * l + c2) * l + c1) * l + c0;
    const double slope = (4.0 * l * l + 2.0 * c2) * l + c1;
    if (!(slope > 0)) break;
    const double change = value / slope;
    l -= change;
    if (std::abs(change) < 1e-12 * l) break;
  }
  return l;
}

// Column c of the adjugate of the symmetric 4 x 4 matrix A, times a sign common to all c.
Vector4d adjugateColumn(const Matrix4d& A, int c) {
  Vector4d column;
  for (int r = 0; r < 4; ++r) {
    Matrix3d minor;
    for (int i = 0, mi = 0; i < 4; ++i) {
      if (i == c) continue;
      for (int j = 0, mj = 0; j < 4; ++j) {
        if (j == r) continue;
        minor(mi, mj++) = A(i, j);
      }
      ++mi;
    }
    column[r] = ((r + c) % 2 == 0 ? 1.0 : -1.0) * minor.determinant();
  }
  return column;
}

Matrix3d toRotation(const Vector4d& q) {
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

}  // namespace

Matrix3d bestRotation(const Matrix3d& S) {
  const Matrix4d K = davenportMatrix(S);
  const double l = largestEigenvalue(K, S);
  const Matrix4d A = K - l * Matrix4d::Identity();
  const double least_norm = 1e-6 * l * l * l;
  for (int c = 0; c < 4; ++c) {
    const Vector4d q = adjugateColumn(A, c);
    const double norm = q.norm();
    if (norm > least_norm) return toRotation(q / norm);
  }
  const Eigen::SelfAdjointEigenSolver<Matrix4d> solver(K);
  return toRotation(solver.eigenvectors().col(3));
}

Matrix3d bestRotationAboutY(const Matrix3d& S) {
  const double along = S(0, 0) + S(2, 2);
  const double across = S(0, 2) - S(2, 0);
  const double norm = std::hypot(along, across);
  Matrix3d R = Matrix3d::Identity();
  if (norm == 0) return R;
  R(0, 0) = R(2, 2) = along / norm;
  R(0, 2) = across / norm;
  R(2, 0) = -across / norm;
  return R;
}

}  // namespace depthmocap

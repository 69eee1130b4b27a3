#include "libtracker/skeleton/block_band.h"

#include <Eigen/Cholesky>

namespace depthmocap {
namespace {

// Rows t of the Cholesky factor L, A = L L^T.
struct FactorRow {
  Eigen::LLT<PoseMatrix> own;  // L_tt
  PoseMatrix back1;            // L_t,t-1
  PoseMatrix back2;            // L_t,t-2
};

// B L^-T for the factor of another frame.
PoseMatrix overTransposed(const Eigen::LLT<PoseMatrix>& L, const PoseMatrix& B) {
  return L.matrixL().solve(B.transpose()).transpose();
}

std::vector<FactorRow> factored(const BlockBand& A) {
  std::vector<FactorRow> rows(A.diagonal.size());
  for (std::size_t t = 0; t < rows.size(); ++t) {
    FactorRow& row = rows[t];
    PoseMatrix rest = A.diagonal[t];
    if (t >= 2) {
      row.back2 = overTransposed(rows[t - 2].own, A.back2[t].asDiagonal());
      rest.noalias() -= row.back2 * row.back2.transpose();
    }
    if (t >= 1) {
      PoseMatrix coupling = A.back1[t].asDiagonal();
      if (t >= 2) coupling.noalias() -= row.back2 * rows[t - 1].back1.transpose();
      row.back1 = overTransposed(rows[t - 1].own, coupling);
      rest.noalias() -= row.back1 * row.back1.transpose();
    }
    row.own.compute(rest);
  }
  return rows;
}

}  // namespace

std::vector<Pose> BlockBand::solve(const std::vector<Pose>& b) const {
  const std::vector<FactorRow> rows = factored(*this);
  std::vector<Pose> x = b;
  for (std::size_t t = 0; t < x.size(); ++t) {
    if (t >= 1) x[t] -= rows[t].back1 * x[t - 1];
    if (t >= 2) x[t] -= rows[t].back2 * x[t - 2];
    rows[t].own.matrixL().solveInPlace(x[t]);
  }
  for (std::size_t t = x.size(); t-- > 0;) {
    if (t + 1 < x.size()) x[t] -= rows[t + 1].back1.transpose() * x[t + 1];
    if (t + 2 < x.size()) x[t] -= rows[t + 2].back2.transpose() * x[t + 2];
    rows[t].own.matrixU().solveInPlace(x[t]);
  }
  return x;
}

std::vector<Pose> BlockBand::times(const std::vector<Pose>& x) const {
  std::vector<Pose> y(x.size());
  for (std::size_t t = 0; t < x.size(); ++t) {
    y[t] = diagonal[t] * x[t];
    if (t >= 1) y[t] += back1[t].cwiseProduct(x[t - 1]);
    if (t >= 2) y[t] += back2[t].cwiseProduct(x[t - 2]);
    if (t + 1 < x.size()) y[t] += back1[t + 1].cwiseProduct(x[t + 1]);
    if (t + 2 < x.size()) y[t] += back2[t + 2].cwiseProduct(x[t + 2]);
  }
  return y;
}

}  // namespace depthmocap

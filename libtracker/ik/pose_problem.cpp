#include "libtracker/ik/pose_problem.h"

#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {

void PoseProblem::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& E, Eigen::MatrixXd* J) {
  const Pose q = x;
  const int rows = measured_.rows();
  if (J == nullptr) {
    measured_.evaluate(q, E.head(rows), nullptr);
  } else {
    J->setZero();
    RowsJacobian measured_rows(J->topRows(rows));
    measured_.evaluate(q, E.head(rows), &measured_rows);
  }
  if (prior_ == nullptr) return;
  Eigen::MatrixXd prior_rows;
  prior_->evaluate(shapeOf(q), E.tail(priorRows()), J == nullptr ? nullptr : &prior_rows);
  E.tail(priorRows()) *= weight_;
  if (J == nullptr) return;
  for (int i = 0; i < kShapeDofCount; ++i) {
    J->col(kShapeDofs[static_cast<std::size_t>(i)]).tail(priorRows()) = weight_ * prior_rows.col(i);
  }
}

Eigen::VectorXd PoseProblem::lower() const {
  return jointLimits().lower;
}

Eigen::VectorXd PoseProblem::upper() const {
  return jointLimits().upper;
}

}  // namespace depthmocap

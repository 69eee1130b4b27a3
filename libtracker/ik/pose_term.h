#pragma once
#include <Eigen/Core>

#include "depthmocap/pose.h"

namespace depthmocap {

using RowsJacobian = Eigen::Ref<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

// What was measured of one pose, as residuals: the first rows of (3.1) of MNN-IK. For one thread at a time.
class PoseTerm {
 public:
  PoseTerm() = default;
  virtual ~PoseTerm() = default;
  PoseTerm(const PoseTerm&) = delete;
  PoseTerm& operator=(const PoseTerm&) = delete;

  [[nodiscard]] virtual int rows() const = 0;
  // r: rows(); J: rows() x kDofCount, d r / d q, or nullptr.
  virtual void evaluate(const Pose& q, Eigen::Ref<Eigen::VectorXd> r, RowsJacobian* J) = 0;
};

}  // namespace depthmocap

#pragma once
#include "libtracker/ik/levenberg_marquardt.h"
#include "libtracker/ik/pose_prior.h"
#include "libtracker/ik/pose_term.h"

namespace depthmocap {

// Problem (3.1) of MNN-IK over q: rows of what was measured [m], then `weight` times those of the prior, if there is
// one; bounds are the joint limits.
class PoseProblem final : public LeastSquaresProblem {
 public:
  // prior may be nullptr; both must outlive the problem. weight: [m] that one unit of the prior is worth.
  explicit PoseProblem(PoseTerm& measured, const PosePrior* prior = nullptr, double weight = 0)
      : measured_(measured), prior_(prior), weight_(weight) {}

  [[nodiscard]] int parameters() const override { return kDofCount; }
  [[nodiscard]] int residuals() const override { return measured_.rows() + priorRows(); }
  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& E, Eigen::MatrixXd* J) override;
  [[nodiscard]] Eigen::VectorXd lower() const override;
  [[nodiscard]] Eigen::VectorXd upper() const override;

 private:
  [[nodiscard]] int priorRows() const { return prior_ == nullptr ? 0 : prior_->rows(); }

  PoseTerm& measured_;
  const PosePrior* prior_;
  double weight_;
};

}  // namespace depthmocap

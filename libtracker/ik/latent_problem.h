#pragma once
#include "libtracker/ik/levenberg_marquardt.h"
#include "libtracker/ik/network_priors.h"
#include "libtracker/ik/target_term.h"

namespace depthmocap {

// Latent IK as a problem over x: place, heading and code of a pose. Rows: those of the targets [m], then the code times
// its weight. Joint limits are no bounds here: they hold of a pose, not of a code.
class LatentProblem final : public LeastSquaresProblem {
 public:
  // All must outlive the problem.
  LatentProblem(const PoseScale& scale, const FastPoseCoder& coder, TargetTerm& targets)
      : scale_(scale), coder_(coder), targets_(targets) {}

  [[nodiscard]] int parameters() const override { return kFreeCount + code(); }
  [[nodiscard]] int residuals() const override { return targets_.rows() + code(); }
  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& E, Eigen::MatrixXd* J) override;
  [[nodiscard]] Eigen::VectorXd lower() const override;
  [[nodiscard]] Eigen::VectorXd upper() const override;

  // x of a pose, by its code: the nearest that the decoder can make; and the pose of x.
  [[nodiscard]] Eigen::VectorXd encoded(const Pose& q) const;
  [[nodiscard]] Pose decoded(const Eigen::VectorXd& x) const { return decoded(x, nullptr); }

 private:
  static constexpr int kFreeCount = 4;  // of place and heading

  [[nodiscard]] int code() const { return coder_.decoder.inputs(); }
  [[nodiscard]] Pose decoded(const Eigen::VectorXd& x, Eigen::MatrixXf* J_decoder) const;

  const PoseScale& scale_;
  const FastPoseCoder& coder_;
  TargetTerm& targets_;
};

}  // namespace depthmocap

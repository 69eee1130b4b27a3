#pragma once
#include <Eigen/Core>
#include <vector>

#include "libtracker/skeleton/local_prior.h"

namespace depthmocap {

// The values of kShapeDofs, in their order [rad]: how the body is bent and tilted, not where it stands.
using PoseShape = Eigen::Matrix<double, kShapeDofCount, 1>;

PoseShape shapeOf(const Pose& q);
// q with these shape DoFs; place and heading stay.
Pose withShape(const Pose& q, const PoseShape& shape);

// How natural a pose is, as residuals that join those of the targets in (3.1) of MNN-IK: a natural pose has small ones.
// Constant after construction, so that threads may share one.
class PosePrior {
 public:
  PosePrior() = default;
  virtual ~PosePrior() = default;
  PosePrior(const PosePrior&) = delete;
  PosePrior& operator=(const PosePrior&) = delete;

  [[nodiscard]] virtual int rows() const = 0;
  // r: rows(); J: rows() x kShapeDofCount, d r / d shape, or nullptr. Without unit; the weight is the solver's.
  virtual void evaluate(const PoseShape& shape, Eigen::Ref<Eigen::VectorXd> r, Eigen::MatrixXd* J) const = 0;
};

}  // namespace depthmocap

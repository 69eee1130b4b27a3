#pragma once
#include "libtracker/ik/dense_network.h"
#include "libtracker/ik/fast_network.h"
#include "libtracker/ik/pose_prior.h"

namespace depthmocap {

// What networks see of a pose: each DoF about its mean over its deviation.
struct PoseScale {
  PoseShape mean = PoseShape::Zero();       // [rad]
  PoseShape deviation = PoseShape::Ones();  // [rad] (> 0)

  [[nodiscard]] Eigen::VectorXf scaled(const PoseShape& shape) const;
  [[nodiscard]] PoseShape unscaled(const Eigen::VectorXf& values) const;
};

// As it was learned.
struct PoseCoder {
  DenseNetwork encoder;  // scaled pose to code; that of the VAE to the code's mean, then the logarithm of its variance
  DenseNetwork decoder;  // code to scaled pose
};

// The same for evaluation.
struct FastPoseCoder {
  explicit FastPoseCoder(const PoseCoder& coder) : encoder(coder.encoder), decoder(coder.decoder) {}

  FastNetwork encoder;
  FastNetwork decoder;
};

// g, (3.3) of MNN-IK: the difference of a pose from its reconstruction by an autoencoder, theta - theta^, in units of
// each DoF's deviation. A row a DoF in place of the paper's one row of its square: as accurate (docs/lab/ik.md), in
// less time.
class AutoencoderPrior final : public PosePrior {
 public:
  AutoencoderPrior(const PoseScale& scale, const PoseCoder& coder) : scale_(scale), coder_(coder) {}

  [[nodiscard]] int rows() const override { return kShapeDofCount; }
  void evaluate(const PoseShape& shape, Eigen::Ref<Eigen::VectorXd> r, Eigen::MatrixXd* J) const override;

 private:
  PoseScale scale_;
  FastPoseCoder coder_;
};

// The same with a variational autoencoder, and the length of the code: a pose is natural that lies near what its code
// stands for, and whose code lies near the middle of N(0, 1) (section C's |z|^2, with code_weight^2).
class VariationalPrior final : public PosePrior {
 public:
  VariationalPrior(const PoseScale& scale, const PoseCoder& coder, double code_weight)
      : scale_(scale), coder_(coder), code_weight_(code_weight) {}

  [[nodiscard]] int rows() const override { return kShapeDofCount + coder_.decoder.inputs(); }
  void evaluate(const PoseShape& shape, Eigen::Ref<Eigen::VectorXd> r, Eigen::MatrixXd* J) const override;

 private:
  PoseScale scale_;
  FastPoseCoder coder_;
  double code_weight_;
};

}  // namespace depthmocap

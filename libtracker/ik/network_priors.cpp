#include "libtracker/ik/network_priors.h"

namespace depthmocap {

Eigen::VectorXf PoseScale::scaled(const PoseShape& shape) const {
  return ((shape - mean).array() / deviation.array()).cast<float>();
}

PoseShape PoseScale::unscaled(const Eigen::VectorXf& values) const {
  return mean + deviation.cwiseProduct(values.cast<double>());
}

void AutoencoderPrior::evaluate(const PoseShape& shape, Eigen::Ref<Eigen::VectorXd> r, Eigen::MatrixXd* J) const {
  const Eigen::VectorXf x = scale_.scaled(shape);
  Eigen::MatrixXf J_encoder;
  Eigen::MatrixXf J_decoder;
  const Eigen::VectorXf code = coder_.encoder.evaluate(x, J == nullptr ? nullptr : &J_encoder);
  const Eigen::VectorXf rebuilt = coder_.decoder.evaluate(code, J == nullptr ? nullptr : &J_decoder);
  r = (x - rebuilt).cast<double>();
  if (J == nullptr) return;
  const Eigen::MatrixXf slope = Eigen::MatrixXf::Identity(kShapeDofCount, kShapeDofCount) - J_decoder * J_encoder;
  *J = slope.cast<double>() * scale_.deviation.cwiseInverse().asDiagonal();
}

void VariationalPrior::evaluate(const PoseShape& shape, Eigen::Ref<Eigen::VectorXd> r, Eigen::MatrixXd* J) const {
  const Eigen::VectorXf x = scale_.scaled(shape);
  const int code = coder_.decoder.inputs();
  Eigen::MatrixXf J_encoder;
  Eigen::MatrixXf J_decoder;
  const Eigen::VectorXf z = coder_.encoder.evaluate(x, J == nullptr ? nullptr : &J_encoder, code).head(code);
  const Eigen::VectorXf rebuilt = coder_.decoder.evaluate(z, J == nullptr ? nullptr : &J_decoder);
  r.head<kShapeDofCount>() = (x - rebuilt).cast<double>();
  r.tail(code) = code_weight_ * z.cast<double>();
  if (J == nullptr) return;
  J->resize(rows(), kShapeDofCount);
  J->topRows(kShapeDofCount) =
      (Eigen::MatrixXf::Identity(kShapeDofCount, kShapeDofCount) - J_decoder * J_encoder).cast<double>();
  J->bottomRows(code) = code_weight_ * J_encoder.cast<double>();
  *J = (*J * scale_.deviation.cwiseInverse().asDiagonal()).eval();
}

}  // namespace depthmocap

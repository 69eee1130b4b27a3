#pragma once
#include <vector>

#include "libtracker/ik/dense_network.h"
#include "libtracker/ik/packed_matrix.h"

namespace depthmocap {

// A DenseNetwork for evaluation alone, in a fraction of its time. Constant after construction: threads may share one.
class FastNetwork {
 public:
  explicit FastNetwork(const DenseNetwork& network);

  [[nodiscard]] int inputs() const { return layers_.front().W.cols(); }
  [[nodiscard]] int outputs() const { return layers_.back().W.rows(); }
  // As DenseNetwork::evaluate, up to rounding. `used_outputs`: with J, the number of the first outputs that it has rows
  // for; 0: all.
  [[nodiscard]] Eigen::VectorXf evaluate(const Eigen::VectorXf& x, Eigen::MatrixXf* J = nullptr,
                                         int used_outputs = 0) const;

 private:
  struct Layer {
    PackedMatrix W;
    PackedMatrix W_transposed;
    Eigen::VectorXf b;
  };
  std::vector<Layer> layers_;
  Eigen::MatrixXf first_W_;
  Eigen::MatrixXf last_W_transposed_;
};

}  // namespace depthmocap

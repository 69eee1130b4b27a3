#pragma once
#include <Eigen/Core>
#include <vector>

namespace depthmocap {

// A matrix of which many products are taken: stored in blocks of rows as the product reads them. Each number of a
// product is summed in the order of the columns, one multiplication and one addition after the other, so that the bits
// of the result do not depend on the processor. Constant after construction: threads may share one.
class PackedMatrix {
 public:
  explicit PackedMatrix(const Eigen::MatrixXf& m);

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int cols() const { return cols_; }
  // This matrix times B: cols() x n.
  [[nodiscard]] Eigen::MatrixXf times(const Eigen::MatrixXf& B) const;

 private:
  int rows_;
  int cols_;
  std::vector<float> blocks_;  // kBlock rows each, column by column; rows beyond the last are 0
};

}  // namespace depthmocap

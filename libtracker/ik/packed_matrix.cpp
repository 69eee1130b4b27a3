#include "libtracker/ik/packed_matrix.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr int kLanes = 8;           // floats of an AVX2 register; without it the compiler takes two or eight
constexpr int kBlock = 2 * kLanes;  // rows that are summed at once
constexpr int kColumns = 5;         // columns of B at once: 10 sums, of the 16 registers there are

using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));

// C = A B for one block of A's rows and kCount columns of B.
template <int kCount>
__attribute__((always_inline)) inline void multiplyTile(const float* A, const float* B, std::ptrdiff_t B_stride,
                                                        int inner, float (*C)[kBlock]) {
  Lanes sums[kCount][2] = {};
  for (int k = 0; k < inner; ++k) {
    Lanes low;
    Lanes high;
    std::memcpy(&low, A, sizeof low);
    std::memcpy(&high, A + kLanes, sizeof high);
    A += kBlock;
    for (int c = 0; c < kCount; ++c) {
      const float b = B[c * B_stride + k];
      sums[c][0] += low * b;
      sums[c][1] += high * b;
    }
  }
  std::memcpy(C, sums, sizeof sums);
}

struct Product {
  const float* blocks;
  const float* B;
  float* C;
  int rows;
  int inner;
  int columns;
};

template <int kCount>
__attribute__((always_inline)) inline void multiplyColumns(const Product& p, int column) {
  float tile[kCount][kBlock];
  for (int row = 0; row < p.rows; row += kBlock) {
    const std::ptrdiff_t block = static_cast<std::ptrdiff_t>(row) * p.inner;
    multiplyTile<kCount>(p.blocks + block, p.B + static_cast<std::ptrdiff_t>(column) * p.inner, p.inner, p.inner, tile);
    const int count = std::min(kBlock, p.rows - row);
    for (int c = 0; c < kCount; ++c) {
      std::copy_n(tile[c], count, p.C + static_cast<std::ptrdiff_t>(column + c) * p.rows + row);
    }
  }
}

__attribute__((always_inline)) inline void multiplyInline(const Product& p) {
  int column = 0;
  for (; column + kColumns <= p.columns; column += kColumns) multiplyColumns<kColumns>(p, column);
  switch (p.columns - column) {
    case 4:
      return multiplyColumns<4>(p, column);
    case 3:
      return multiplyColumns<3>(p, column);
    case 2:
      return multiplyColumns<2>(p, column);
    case 1:
      return multiplyColumns<1>(p, column);
    default:
      return;
  }
}

void multiply(const Product& p) {
  multiplyInline(p);
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) void multiplyAvx2(const Product& p) {
  multiplyInline(p);
}
#endif

using Multiply = void (*)(const Product&);

Multiply chooseMultiply() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return multiplyAvx2;
#endif
  return multiply;
}

}  // namespace

PackedMatrix::PackedMatrix(const Eigen::MatrixXf& m)
    : rows_(static_cast<int>(m.rows())), cols_(static_cast<int>(m.cols())) {
  for (int row = 0; row < rows_; row += kBlock) {
    for (int col = 0; col < cols_; ++col) {
      for (int i = row; i < row + kBlock; ++i) blocks_.push_back(i < rows_ ? m(i, col) : 0.0F);
    }
  }
}

Eigen::MatrixXf PackedMatrix::times(const Eigen::MatrixXf& B) const {
  DMC_CHECK(B.rows() == cols_);
  static const Multiply chosen = chooseMultiply();
  Eigen::MatrixXf C(rows_, B.cols());
  chosen({blocks_.data(), B.data(), C.data(), rows_, cols_, static_cast<int>(B.cols())});
  return C;
}

}  // namespace depthmocap

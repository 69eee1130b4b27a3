#include "libtracker/classify/convolution.h"

#include <algorithm>
#include <cstring>
#include <initializer_list>

#include "libtracker/core/check.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

// Outputs that are computed together, and pixels of them: their sums fit the registers of AVX2.
constexpr int kBlock = 4;
constexpr int kLanes = 8;
constexpr int kPixels = 2 * kLanes;
constexpr int kRowsPerTask = 4;

using Vector = float __attribute__((vector_size(kLanes * sizeof(float))));

std::size_t product(std::initializer_list<int> factors) {
  std::size_t result = 1;
  for (const int factor : factors) result *= static_cast<std::size_t>(factor);
  return result;
}

int roundedUp(int value, int multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

// Where the inputs of one row of outputs are, for each of the kernel's taps: the map's offset is added.
struct Taps {
  const float* first[25];
  int count = 0;
};

// Sixteen pixels of four outputs. Inlined into functions for different vector units, whose results are the same: each
// lane is a sum of its own, in the order of the inputs and taps.
__attribute__((always_inline)) inline void convolvePixels(const Taps& taps, std::ptrdiff_t map_size, int inputs,
                                                          const float* weights, int x, const float* biases,
                                                          float (*sums)[kPixels]) {
  Vector a0, a1, b0, b1, c0, c1, d0, d1;
  a0 = a1 = Vector{} + biases[0];
  b0 = b1 = Vector{} + biases[1];
  c0 = c1 = Vector{} + biases[2];
  d0 = d1 = Vector{} + biases[3];
  for (int i = 0; i < inputs; ++i) {
    for (int t = 0; t < taps.count; ++t) {
      const float* from = taps.first[t] + i * map_size + x;
      Vector p0;
      Vector p1;
      std::memcpy(&p0, from, sizeof p0);
      std::memcpy(&p1, from + kLanes, sizeof p1);
      a0 += p0 * weights[0];
      a1 += p1 * weights[0];
      b0 += p0 * weights[1];
      b1 += p1 * weights[1];
      c0 += p0 * weights[2];
      c1 += p1 * weights[2];
      d0 += p0 * weights[3];
      d1 += p1 * weights[3];
      weights += kBlock;
    }
  }
  std::memcpy(sums[0], &a0, sizeof a0);
  std::memcpy(sums[0] + kLanes, &a1, sizeof a1);
  std::memcpy(sums[1], &b0, sizeof b0);
  std::memcpy(sums[1] + kLanes, &b1, sizeof b1);
  std::memcpy(sums[2], &c0, sizeof c0);
  std::memcpy(sums[2] + kLanes, &c1, sizeof c1);
  std::memcpy(sums[3], &d0, sizeof d0);
  std::memcpy(sums[3] + kLanes, &d1, sizeof d1);
}

// One row of one block of outputs.
struct RowJob {
  Taps taps;
  std::ptrdiff_t map_size;
  int inputs;
  const float* weights;
  float biases[kBlock];
  int outputs;  // of the block
  int width;
  bool rectify;
  float* to[kBlock];
};

__attribute__((always_inline)) inline void convolveRowInline(const RowJob& job) {
  float sums[kBlock][kPixels];
  for (int x = 0; x < job.width; x += kPixels) {
    convolvePixels(job.taps, job.map_size, job.inputs, job.weights, x, job.biases, sums);
    const int count = std::min(kPixels, job.width - x);
    for (int o = 0; o < job.outputs; ++o) {
      for (int k = 0; k < count; ++k) job.to[o][x + k] = job.rectify ? std::max(0.0F, sums[o][k]) : sums[o][k];
    }
  }
}

void convolveRow(const RowJob& job) {
  convolveRowInline(job);
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) void convolveRowAvx2(const RowJob& job) {
  convolveRowInline(job);
}
#endif

using ConvolveRow = void (*)(const RowJob&);

ConvolveRow chooseConvolveRow() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return convolveRowAvx2;
#endif
  return convolveRow;
}

// Of a stride of 2 the even and the odd columns become maps of their own, so that taps read neighbours again.
void splitColumns(const FeatureMaps& input, FeatureMaps& split) {
  const int width = (input.width() + 1) / 2;
  split.resize(2 * input.maps(), width, input.height());
  for (int m = 0; m < input.maps(); ++m) {
    for (int y = 0; y < input.height(); ++y) {
      const float* from = input.row(m, y);
      float* even = split.row(m, y);
      float* odd = split.row(input.maps() + m, y);
      for (int x = 0; x < width; ++x) {
        even[x] = from[2 * x];
        odd[x] = from[2 * x + 1];
      }
    }
  }
}

}  // namespace

void FeatureMaps::resize(int maps, int width, int height) {
  if (maps == maps_ && width == width_ && height == height_) return;
  maps_ = maps;
  width_ = width;
  height_ = height;
  pitch_ = roundedUp(width, kPixels) + 2 * kBorder + kLanes;
  data_.assign(static_cast<std::size_t>(maps * mapSize()) + kPixels, 0.0F);
}

void ConvolutionLayer::prepare() {
  const int taps = kernel * kernel;
  DMC_CHECK(weights.size() == product({outputs, inputs, taps}));
  DMC_CHECK(biases.size() == static_cast<std::size_t>(outputs));
  const int blocks = roundedUp(outputs, kBlock) / kBlock;
  by_block.assign(product({blocks, inputs, taps, kBlock}), 0.0F);
  std::size_t at = 0;
  for (int block = 0; block < blocks; ++block) {
    for (int i = 0; i < inputs; ++i) {
      for (int t = 0; t < taps; ++t) {
        for (int o = kBlock * block; o < kBlock * (block + 1); ++o, ++at) {
          if (o < outputs) by_block[at] = weights[product({o * inputs + i, taps}) + static_cast<std::size_t>(t)];
        }
      }
    }
  }
}

void convolve(const ConvolutionLayer& layer, const FeatureMaps& input, bool rectify, int threads, FeatureMaps& working,
              FeatureMaps& output) {
  DMC_CHECK(input.maps() == layer.inputs && !layer.by_block.empty());
  const int stride = layer.stride;
  if (stride == 2) splitColumns(input, working);
  const FeatureMaps& from = stride == 2 ? working : input;
  const int reach = layer.dilation * (layer.kernel / 2);
  output.resize(layer.outputs, (input.width() + stride - 1) / stride, (input.height() + stride - 1) / stride);
  const ConvolveRow convolve_row = chooseConvolveRow();
  const int blocks = roundedUp(layer.outputs, kBlock) / kBlock;
  const int tasks = (output.height() + kRowsPerTask - 1) / kRowsPerTask;
  parallelFor(threads, static_cast<std::size_t>(tasks), [&](std::size_t task) {
    RowJob job{};
    job.map_size = from.mapSize();
    job.inputs = layer.inputs;
    job.width = output.width();
    job.rectify = rectify;
    const int first = static_cast<int>(task) * kRowsPerTask;
    for (int y = first; y < std::min(first + kRowsPerTask, output.height()); ++y) {
      job.taps.count = 0;
      for (int ky = 0; ky < layer.kernel; ++ky) {
        for (int kx = 0; kx < layer.kernel; ++kx) {
          const int row = y * stride + ky * layer.dilation - reach;
          const int column = kx * layer.dilation - reach;
          const bool odd = stride == 2 && column % 2 != 0;
          const int shifted = stride == 2 ? (column - (odd ? 1 : 0)) / 2 : column;
          job.taps.first[job.taps.count++] = from.row(odd ? layer.inputs : 0, row) + shifted;
        }
      }
      for (int block = 0; block < blocks; ++block) {
        const int o = kBlock * block;
        job.outputs = std::min(kBlock, layer.outputs - o);
        job.weights = layer.by_block.data() +
                      static_cast<std::ptrdiff_t>(block) * layer.inputs * layer.kernel * layer.kernel * kBlock;
        const float* biases = layer.biases.data() + o;
        for (int k = 0; k < job.outputs; ++k) {
          job.biases[k] = biases[k];
          job.to[k] = output.row(o + k, y);
        }
        convolve_row(job);
      }
    }
  });
}

void convolveReference(const ConvolutionLayer& layer, const FeatureMaps& input, bool rectify, FeatureMaps& output) {
  const int reach = layer.dilation * (layer.kernel / 2);
  output.resize(layer.outputs, (input.width() + layer.stride - 1) / layer.stride,
                (input.height() + layer.stride - 1) / layer.stride);
  for (int o = 0; o < layer.outputs; ++o) {
    for (int y = 0; y < output.height(); ++y) {
      for (int x = 0; x < output.width(); ++x) {
        float sum = layer.biases[static_cast<std::size_t>(o)];
        std::size_t w = product({o, layer.inputs, layer.kernel, layer.kernel});
        for (int i = 0; i < layer.inputs; ++i) {
          for (int ky = 0; ky < layer.kernel; ++ky) {
            for (int kx = 0; kx < layer.kernel; ++kx, ++w) {
              const int row = y * layer.stride + ky * layer.dilation - reach;
              const int column = x * layer.stride + kx * layer.dilation - reach;
              const bool inside = row >= 0 && row < input.height() && column >= 0 && column < input.width();
              sum += (inside ? input.row(i, row)[column] : 0.0F) * layer.weights[w];
            }
          }
        }
        output.row(o, y)[x] = rectify ? std::max(0.0F, sum) : sum;
      }
    }
  }
}

}  // namespace depthmocap

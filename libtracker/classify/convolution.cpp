#include "libtracker/classify/convolution.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

#include "libtracker/classify/convolve_row.h"
#include "libtracker/core/check.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

constexpr int kRowsPerTask = 4;

std::size_t product(std::initializer_list<int> factors) {
  std::size_t result = 1;
  for (const int factor : factors) result *= static_cast<std::size_t>(factor);
  return result;
}

int blocksOf(const ConvolutionLayer& layer) {
  return (layer.outputs + kOutputBlock - 1) / kOutputBlock;
}

int pairsOf(const ConvolutionLayer& layer) {
  return (layer.inputs + 1) / 2;
}

// What 1 stands for in the whole numbers of one output's weights: the largest of them has 16 bits at most, and no sum
// of products with inputs of PairedMaps::kMost has more than 32.
float unitOf(const float* weights, std::size_t count) {
  constexpr std::int32_t kMostWhole = std::numeric_limits<std::int32_t>::max() / PairedMaps::kMost;
  constexpr double kMostSum = kMostWhole;
  double most = 0;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    most = std::max(most, static_cast<double>(std::abs(weights[i])));
    sum += static_cast<double>(std::abs(weights[i]));
  }
  const double room = kMostSum - static_cast<double>(count);  // each weight is rounded
  const double unit = std::max(most / std::numeric_limits<std::int16_t>::max(), sum / room);
  return unit > 0 ? static_cast<float>(unit) : 1.0F;
}

// Where the taps of a row of outputs read.
void placeTaps(const ConvolutionLayer& layer, const PairedMaps& from, int y, RowJob& job) {
  const int reach = layer.dilation * (layer.kernel / 2);
  job.tap_count = 0;
  for (int ky = 0; ky < layer.kernel; ++ky) {
    for (int kx = 0; kx < layer.kernel; ++kx) {
      const int row = y * layer.stride + ky * layer.dilation - reach;
      const int column = kx * layer.dilation - reach;
      const bool odd = layer.stride == 2 && column % 2 != 0;
      const int shifted = (column - (odd ? 1 : 0)) / layer.stride;
      job.taps[static_cast<std::size_t>(job.tap_count++)] = from.row(odd ? from.pairs() : 0, row) + shifted;
    }
  }
}

}  // namespace

void ConvolutionLayer::prepare() {
  const int taps = kernel * kernel;
  DMC_CHECK(taps <= RowJob::kMostTaps);
  DMC_CHECK(weights.size() == product({outputs, inputs, taps}));
  DMC_CHECK(biases.size() == static_cast<std::size_t>(outputs));
  units.resize(biases.size());
  for (int o = 0; o < outputs; ++o) {
    units[static_cast<std::size_t>(o)] = unitOf(&weights[product({o, inputs, taps})], product({inputs, taps}));
  }
  const int pairs = pairsOf(*this);
  by_block.assign(product({blocksOf(*this), pairs, taps, kOutputBlock}), 0);
  for (int o = 0; o < outputs; ++o) {
    for (int i = 0; i < inputs; ++i) {
      for (int t = 0; t < taps; ++t) {
        const int block = o / kOutputBlock;
        const int place = ((block * pairs + i / 2) * taps + t) * kOutputBlock + o % kOutputBlock;
        const float weight = weights[product({o * inputs + i, taps}) + static_cast<std::size_t>(t)];
        const auto whole = static_cast<std::int32_t>(std::lround(weight / units[static_cast<std::size_t>(o)]));
        std::int32_t& pair = by_block[static_cast<std::size_t>(place)];
        pair |= i % 2 == 0 ? whole & 0xFFFF : static_cast<std::int32_t>(static_cast<std::uint32_t>(whole) << 16U);
      }
    }
  }
}

void convolve(const ConvolutionLayer& layer, const FeatureMaps& input, const ConvolveOptions& options,
              PairedMaps& working, FeatureMaps& output) {
  DMC_CHECK(input.maps() == layer.inputs && !layer.by_block.empty());
  working.fill(input, layer.stride);
  output.resize(layer.outputs, (input.width() + layer.stride - 1) / layer.stride,
                (input.height() + layer.stride - 1) / layer.stride);
  const ConvolveRow convolve_row = convolveRowFor(options.simd);
  const std::size_t block_size = product({pairsOf(layer), layer.kernel, layer.kernel, kOutputBlock});
  const int tasks = (output.height() + kRowsPerTask - 1) / kRowsPerTask;
  parallelFor(options.threads, static_cast<std::size_t>(tasks), [&](std::size_t task) {
    RowJob job;
    job.pair_size = working.pairSize();
    job.pairs = working.pairs();
    job.width = output.width();
    job.least = options.rectify ? 0.0F : -kMostOutput;
    const int first = static_cast<int>(task) * kRowsPerTask;
    for (int y = first; y < std::min(first + kRowsPerTask, output.height()); ++y) {
      placeTaps(layer, working, y, job);
      for (int block = 0; block < blocksOf(layer); ++block) {
        const int o = kOutputBlock * block;
        job.outputs = std::min(kOutputBlock, layer.outputs - o);
        job.weights = layer.by_block.data() + static_cast<std::size_t>(block) * block_size;
        for (int k = 0; k < job.outputs; ++k) {
          const auto here = static_cast<std::size_t>(k);
          job.units[here] = working.unit() * layer.units[static_cast<std::size_t>(o) + here];
          job.biases[here] = layer.biases[static_cast<std::size_t>(o) + here];
          job.to[here] = output.row(o + k, y);
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

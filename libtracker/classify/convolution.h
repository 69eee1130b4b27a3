#pragma once
#include <cstdint>
#include <vector>

#include "libtracker/classify/feature_maps.h"
#include "libtracker/classify/paired_maps.h"

namespace depthmocap {

// A convolution with as many zeros around its input as keep the size; then max(0, x) unless it is the last layer.
struct ConvolutionLayer {
  int inputs = 0;
  int outputs = 0;
  int kernel = 1;              // 1, 3 or 5
  int stride = 1;              // 1 or 2
  int dilation = 1;            // 1 or 2; dilation * (kernel - 1) / 2 <= PairedMaps::kBorder
  std::vector<float> weights;  // [outputs][inputs][kernel][kernel]
  std::vector<float> biases;   // [outputs]

  // As convolve() reads the weights: in whole numbers of as many bits as the sums have room for, paired as the maps
  // are.
  std::vector<std::int32_t> by_block;
  std::vector<float> units;  // [outputs] what 1 in by_block stands for

  void prepare();
};

struct ConvolveOptions {
  bool rectify = true;
  int threads = 1;
  bool simd = true;  // instructions that not every machine has; the result does not depend on it
};

// `output` gets the size of `input` over the stride, rounded up. The input is taken in steps of 1/8191 of its largest
// value. The same bits for any number of threads and with any vector unit: sums are of whole numbers. `working` is best
// kept for the same layer: it keeps its memory.
void convolve(const ConvolutionLayer& layer, const FeatureMaps& input, const ConvolveOptions& options,
              PairedMaps& working, FeatureMaps& output);
// The definition, in real numbers.
void convolveReference(const ConvolutionLayer& layer, const FeatureMaps& input, bool rectify, FeatureMaps& output);

}  // namespace depthmocap

#include "libtracker/classify/convolution.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

struct Shape {
  int inputs, outputs, kernel, stride, dilation, width, height;
};

ConvolutionLayer randomLayer(const Shape& s, Random& random) {
  ConvolutionLayer layer{s.inputs, s.outputs, s.kernel, s.stride, s.dilation, {}, {}, {}, {}};
  layer.weights.resize(static_cast<std::size_t>(s.outputs * s.inputs * s.kernel * s.kernel));
  layer.biases.resize(static_cast<std::size_t>(s.outputs));
  for (float& w : layer.weights) w = static_cast<float>(random.normal());
  for (float& b : layer.biases) b = static_cast<float>(random.normal());
  layer.prepare();
  return layer;
}

FeatureMaps randomMaps(const Shape& s, Random& random) {
  FeatureMaps maps;
  maps.resize(s.inputs, s.width, s.height);
  for (int m = 0; m < s.inputs; ++m) {
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) maps.row(m, y)[x] = static_cast<float>(random.normal());
    }
  }
  return maps;
}

float largest(const FeatureMaps& maps) {
  float most = 0;
  for (int m = 0; m < maps.maps(); ++m) {
    for (int y = 0; y < maps.height(); ++y) {
      for (int x = 0; x < maps.width(); ++x) most = std::max(most, std::abs(maps.row(m, y)[x]));
    }
  }
  return most;
}

void expectNear(const FeatureMaps& a, const FeatureMaps& b, float tolerance) {
  ASSERT_EQ(a.maps(), b.maps());
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  for (int m = 0; m < a.maps(); ++m) {
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) {
        ASSERT_NEAR(a.row(m, y)[x], b.row(m, y)[x], tolerance) << m << ' ' << x << ' ' << y;
      }
    }
  }
}

class Convolution : public testing::TestWithParam<Shape> {};

// Inputs have 8191 steps, so sums of a hundred products are good to a thousandth of the largest.
TEST_P(Convolution, IsItsDefinitionAsFarAsWholeNumbersGo) {
  Random random(3);
  const ConvolutionLayer layer = randomLayer(GetParam(), random);
  const FeatureMaps input = randomMaps(GetParam(), random);
  for (const bool rectify : {false, true}) {
    FeatureMaps expected;
    FeatureMaps output;
    PairedMaps working;
    convolveReference(layer, input, rectify, expected);
    convolve(layer, input, {.rectify = rectify}, working, output);
    expectNear(output, expected, 0.001F * largest(expected));
  }
}

TEST_P(Convolution, IsTheSameForAnyNumberOfThreadsAndVectorUnit) {
  Random random(4);
  const ConvolutionLayer layer = randomLayer(GetParam(), random);
  const FeatureMaps input = randomMaps(GetParam(), random);
  FeatureMaps expected;
  FeatureMaps output;
  PairedMaps working;
  PairedMaps reused;
  convolve(layer, input, {.threads = 1, .simd = false}, working, expected);
  for (const int threads : {1, 2, 3}) {
    convolve(layer, input, {.threads = threads}, reused, output);
    expectNear(output, expected, 0.0F);
  }
}

// The largest inputs and weights that there are, all of one sign: a sum that did not fit would change it.
TEST(ConvolutionSums, FitWhereAllIsAsLargeAsCanBe) {
  const Shape shape{64, 4, 5, 1, 1, 16, 8};
  ConvolutionLayer layer{shape.inputs, shape.outputs, shape.kernel, 1, 1, {}, {}, {}, {}};
  layer.weights.assign(static_cast<std::size_t>(shape.inputs * shape.outputs * 25), 1.0F);
  layer.biases.assign(4, 0.0F);
  layer.prepare();
  FeatureMaps input;
  input.resize(shape.inputs, shape.width, shape.height);
  for (int m = 0; m < shape.inputs; ++m) {
    for (int y = 0; y < shape.height; ++y) std::fill_n(input.row(m, y), shape.width, 2.0F);
  }
  FeatureMaps output;
  PairedMaps working;
  convolve(layer, input, {}, working, output);
  EXPECT_NEAR(output.row(0, 4)[8], 2.0 * 64 * 25, 0.001 * 2 * 64 * 25);
}

// Weights that no training gives, through more layers than the network has.
TEST(ConvolutionSums, StayFiniteWhateverTheWeights) {
  Random random(6);
  const Shape shape{4, 4, 3, 1, 1, 18, 6};
  ConvolutionLayer layer = randomLayer(shape, random);
  for (float& weight : layer.weights) weight *= 1e6F;
  layer.prepare();
  for (const bool simd : {false, true}) {
    FeatureMaps maps = randomMaps(shape, random);
    for (int depth = 0; depth < 15; ++depth) {
      FeatureMaps next;
      PairedMaps working;
      convolve(layer, maps, {.rectify = false, .simd = simd}, working, next);
      std::swap(maps, next);
    }
    EXPECT_TRUE(std::isfinite(largest(maps)));
    EXPECT_GT(largest(maps), 1e10F);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Convolution,
                         testing::Values(Shape{4, 12, 5, 2, 1, 160, 32}, Shape{3, 5, 3, 1, 1, 17, 9},
                                         Shape{2, 7, 3, 1, 2, 10, 7}, Shape{5, 3, 1, 1, 1, 33, 4},
                                         Shape{6, 8, 3, 2, 1, 21, 11}));

}  // namespace
}  // namespace depthmocap

#include "libtracker/classify/convolution.h"

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

struct Shape {
  int inputs, outputs, kernel, stride, dilation, width, height;
};

ConvolutionLayer randomLayer(const Shape& s, Random& random) {
  ConvolutionLayer layer{s.inputs, s.outputs, s.kernel, s.stride, s.dilation, {}, {}, {}};
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

// Both are sums in the same order: equal to the last bit.
void expectSame(const FeatureMaps& a, const FeatureMaps& b) {
  ASSERT_EQ(a.maps(), b.maps());
  ASSERT_EQ(a.width(), b.width());
  ASSERT_EQ(a.height(), b.height());
  for (int m = 0; m < a.maps(); ++m) {
    for (int y = 0; y < a.height(); ++y) {
      for (int x = 0; x < a.width(); ++x) ASSERT_EQ(a.row(m, y)[x], b.row(m, y)[x]) << m << ' ' << x << ' ' << y;
    }
  }
}

class Convolution : public testing::TestWithParam<Shape> {};

TEST_P(Convolution, IsItsDefinitionForAnyNumberOfThreads) {
  Random random(3);
  const ConvolutionLayer layer = randomLayer(GetParam(), random);
  const FeatureMaps input = randomMaps(GetParam(), random);
  for (const bool rectify : {false, true}) {
    FeatureMaps expected;
    convolveReference(layer, input, rectify, expected);
    for (const int threads : {1, 2, 3}) {
      FeatureMaps working;
      FeatureMaps output;
      convolve(layer, input, rectify, threads, working, output);
      expectSame(output, expected);
      convolve(layer, input, rectify, threads, working, output);  // with memory that was used before
      expectSame(output, expected);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Convolution,
                         testing::Values(Shape{4, 12, 5, 2, 1, 160, 32}, Shape{3, 5, 3, 1, 1, 17, 9},
                                         Shape{2, 7, 3, 1, 2, 10, 7}, Shape{5, 3, 1, 1, 1, 33, 4},
                                         Shape{6, 8, 3, 2, 1, 21, 11}));

TEST(FeatureMaps, BordersStayZero) {
  Random random(5);
  const Shape shape{2, 4, 3, 1, 1, 18, 6};
  const FeatureMaps input = randomMaps(shape, random);
  FeatureMaps working;
  FeatureMaps output;
  convolve(randomLayer(shape, random), input, false, 1, working, output);
  for (int m = 0; m < 4; ++m) {
    for (int y = -FeatureMaps::kBorder; y < 6 + FeatureMaps::kBorder; ++y) {
      for (const int x : {-2, -1, 18, 19}) EXPECT_EQ(output.row(m, y)[x], 0.0F);
    }
  }
}

}  // namespace
}  // namespace depthmocap

#pragma once
#include <cstddef>
#include <vector>

namespace depthmocap {

// Several images of one size, one after the other, each with a border of zeros and room at the end of its rows, so that
// convolutions read whole vectors without asking where the image ends. Borders are never written.
class FeatureMaps {
 public:
  static constexpr int kBorder = 2;  // [px] on each side: half of the largest kernel, or a dilation of 2

  // All zero where the size is another one; else as it was. Keeps its memory.
  void resize(int maps, int width, int height);

  [[nodiscard]] int maps() const { return maps_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] std::ptrdiff_t pitch() const { return pitch_; }
  // Pixel (0, y) of a map; y in [-kBorder, height + kBorder), columns from -kBorder on.
  [[nodiscard]] float* row(int map, int y) { return data_.data() + offset(map, y); }
  [[nodiscard]] const float* row(int map, int y) const { return data_.data() + offset(map, y); }
  [[nodiscard]] std::ptrdiff_t mapSize() const { return pitch_ * (height_ + 2 * kBorder); }

 private:
  [[nodiscard]] std::ptrdiff_t offset(int map, int y) const {
    return map * mapSize() + (y + kBorder) * pitch_ + kBorder;
  }

  int maps_ = 0;
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t pitch_ = 0;
  std::vector<float> data_;
};

// A convolution with as many zeros around its input as keep the size; then max(0, x) unless it is the last layer.
struct ConvolutionLayer {
  int inputs = 0;
  int outputs = 0;
  int kernel = 1;               // 1, 3 or 5
  int stride = 1;               // 1 or 2
  int dilation = 1;             // 1 or 2; dilation * (kernel - 1) / 2 <= FeatureMaps::kBorder
  std::vector<float> weights;   // [outputs][inputs][kernel][kernel]
  std::vector<float> biases;    // [outputs]
  std::vector<float> by_block;  // the weights as convolve() reads them; see prepare()

  void prepare();
};

// `output` gets the size of `input` over the stride, rounded up. The same bits for any number of threads and with any
// vector unit: every sum is taken in the same order. `working` keeps its memory.
void convolve(const ConvolutionLayer& layer, const FeatureMaps& input, bool rectify, int threads, FeatureMaps& working,
              FeatureMaps& output);
// The definition that convolve() is tested against.
void convolveReference(const ConvolutionLayer& layer, const FeatureMaps& input, bool rectify, FeatureMaps& output);

}  // namespace depthmocap

#include "libtracker/classify/room_classifier.h"

#include <algorithm>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

// [px] Larger side of the image that the network looks at, about; it was trained on images of this size.
constexpr int kCoarseSide = 160;
// The network's answer is half the size of what it looks at.
constexpr int kAnswerStride = 2;

// Units of the network's inputs, as in scripts/train-rooms.
constexpr float kDepthUnit_m = 3.0F;
constexpr float kInverseUnit = 2.0F;   // [1/m]
constexpr float kLeastDepth_m = 0.1F;  // of which the inverse is taken
constexpr float kPixelScale = 30.0F;   // [1/m] times the size of a pixel at its depth

int roundedUp(int value, int multiple) {
  return (value + multiple - 1) / multiple * multiple;
}

// Every step-th pixel of an image.
struct Coarse {
  int step;
  int first;
  int width;
  int height;

  explicit Coarse(const DepthImage& depth)
      : step(std::max(1, std::max(depth.width, depth.height) / kCoarseSide)),
        first(step / 2),
        width((depth.width - first + step - 1) / step),
        height((depth.height - first + step - 1) / step) {}
};

void fillInput(const DepthImage& depth, const Coarse& coarse, float focal_px, float min_m, float max_m,
               FeatureMaps& input) {
  input.resize(RoomNetwork::kInputs, roundedUp(coarse.width, RoomNetwork::kMultiple),
               roundedUp(coarse.height, RoomNetwork::kMultiple));
  for (int y = 0; y < coarse.height; ++y) {
    float* scaled = input.row(0, y);
    float* measured = input.row(1, y);
    float* inverse = input.row(2, y);
    float* pixel_size = input.row(3, y);
    const float* from = &depth.at(coarse.first, coarse.first + y * coarse.step);
    for (int x = 0; x < coarse.width; ++x) {
      float z = from[x * coarse.step];
      if (!(z > 0 && z >= min_m && z <= max_m)) z = 0;
      scaled[x] = z / kDepthUnit_m;
      measured[x] = z > 0 ? 1.0F : 0.0F;
      inverse[x] = z > 0 ? 1.0F / std::max(z, kLeastDepth_m) / kInverseUnit : 0.0F;
      pixel_size[x] = z / focal_px * kPixelScale;
    }
  }
}

}  // namespace

void RoomClassifier::classify(const DepthImage& depth, const CameraModel& camera, double min_depth_m,
                              double max_depth_m, int threads, Memory& memory, RoomMap& map) const {
  DMC_CHECK(depth.width == camera.width && depth.height == camera.height && !depth.empty());
  const Coarse coarse(depth);
  fillInput(depth, coarse, static_cast<float>(camera.fx / coarse.step), static_cast<float>(min_depth_m),
            static_cast<float>(max_depth_m), memory.input);
  const FeatureMaps& scores = evaluate(network_, threads, memory);

  map.stride = coarse.step * kAnswerStride;
  map.offset = coarse.first;
  map.width = (coarse.width + kAnswerStride - 1) / kAnswerStride;
  map.height = (coarse.height + kAnswerStride - 1) / kAnswerStride;
  map.person.assign(map.index(0, map.height), 0.0F);
  map.shell.assign(map.person.size(), 0.0F);
  map.measured.assign(map.person.size(), 0);
  for (int y = 0; y < map.height; ++y) {
    const float* measured = memory.input.row(1, kAnswerStride * y);
    const float* person = scores.row(0, y);
    const float* shell = scores.row(1, y);
    const float* thing = scores.row(2, y);
    for (int x = 0; x < map.width; ++x) {
      if (measured[kAnswerStride * x] == 0) continue;
      const std::size_t i = map.index(x, y);
      map.measured[i] = 1;
      map.person[i] = person[x] - std::max(shell[x], thing[x]);
      map.shell[i] = shell[x] - std::max(person[x], thing[x]);
    }
  }
}

}  // namespace depthmocap

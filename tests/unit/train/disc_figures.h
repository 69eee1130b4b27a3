#pragma once
#include <array>
#include <string>

#include "depthmocap/parts.h"
#include "forest/train/training_image.h"
#include "libtracker/core/random.h"

namespace depthmocap::test {

// Figures of fifteen discs, one per part, in the places of a person's parts seen from the front, at random distances.
class DiscFigures : public TrainingImageSource {
 public:
  DiscFigures(std::size_t count, std::uint64_t seed) : count_(count), seed_(seed) {}
  [[nodiscard]] std::size_t count() const override { return count_; }
  [[nodiscard]] std::string description() const override { return "disc figures " + std::to_string(seed_); }

  void render(std::size_t i, TrainingImage& image) override {
    struct Disc {
      double x, y, radius;  // [m]
    };
    // Left parts are at the right side of the image: the figure faces the camera.
    constexpr std::array<Disc, kPartCount> kDiscs = {{{0, -0.75, 0.12},
                                                      {0, -0.56, 0.06},
                                                      {0.2, -0.45, 0.1},
                                                      {-0.2, -0.45, 0.1},
                                                      {0.35, -0.3, 0.09},
                                                      {-0.35, -0.3, 0.09},
                                                      {0.45, -0.05, 0.08},
                                                      {-0.45, -0.05, 0.08},
                                                      {0, -0.3, 0.17},
                                                      {0.1, 0.0, 0.12},
                                                      {-0.1, 0.0, 0.12},
                                                      {0.14, 0.3, 0.11},
                                                      {-0.14, 0.3, 0.11},
                                                      {0.14, 0.65, 0.1},
                                                      {-0.14, 0.65, 0.1}}};
    Random random(seed_, i);
    image.focal_px = 130;
    image.facing = static_cast<Facing>(i % kFacingCount);
    image.depth.reset(160, 120, 0);
    image.labels.reset(160, 120, 0);
    const double distance = random.uniform(2, 4);
    const double middle = random.uniform(60, 100);
    for (std::size_t part = 0; part < kPartCount; ++part) {
      const Disc& disc = kDiscs[part];
      const double depth = distance + random.uniform(-0.05, 0.05);
      const double cx = middle + image.focal_px * disc.x / depth;
      const double cy = 60 + image.focal_px * (disc.y + random.uniform(-0.03, 0.03)) / depth;
      const double radius = image.focal_px * disc.radius / depth;
      for (int y = 0; y < 120; ++y) {
        for (int x = 0; x < 160; ++x) {
          if ((x - cx) * (x - cx) + (y - cy) * (y - cy) > radius * radius) continue;
          image.depth.at(x, y) = static_cast<float>(depth);
          image.labels.at(x, y) = static_cast<std::uint8_t>(part + 1);
        }
      }
    }
  }

 private:
  std::size_t count_;
  std::uint64_t seed_;
};

}  // namespace depthmocap::test

#pragma once
#include <cstddef>
#include <cstdint>

#include "depthmocap/image.h"
#include "libtracker/classify/forest.h"
#include "libtracker/core/random.h"

namespace depthmocap::test {

// A tree of random splits with about `splits` of them, breadth-first, every leaf with some probability.
inline ForestTree randomTree(std::size_t splits, int facings, Random& random) {
  ForestTree tree;
  tree.nodes.resize(1);
  std::size_t done = 0;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    if (done < splits && (random.uniform() < 0.8 || i + 1 == tree.nodes.size())) {
      const auto offset = [&] { return static_cast<std::int16_t>(static_cast<int>(random.below(401)) - 200); };
      ForestNode& node = tree.nodes[i];
      node.u = {offset(), offset()};
      node.v = random.below(3) == 0 ? std::array<std::int16_t, 2>{} : std::array<std::int16_t, 2>{offset(), offset()};
      node.threshold_m = static_cast<float>(static_cast<int>(random.below(600)) - 300) * 0.001F;
      node.child = static_cast<std::int32_t>(tree.nodes.size());
      tree.nodes.resize(tree.nodes.size() + 2);
      ++done;
    } else {
      tree.nodes[i].child = -static_cast<std::int32_t>(tree.leaves.size() / static_cast<std::size_t>(facings));
      for (int facing = 0; facing < facings; ++facing) {
        auto& leaf = tree.leaves.emplace_back();
        for (std::size_t part = 0; part < kPartCount; ++part) {
          leaf[part] = static_cast<std::uint8_t>(random.below(256 / static_cast<std::uint32_t>(facings)));
        }
      }
      tree.leaves.back()[random.below(kPartCount)] = 255;
    }
  }
  return tree;
}

inline Forest randomForest(std::size_t trees, std::size_t splits, std::uint64_t seed, int facings = 1) {
  Random random(seed);
  Forest forest;
  forest.origin = "random";
  forest.facings = facings;
  for (std::size_t t = 0; t < trees; ++t) forest.trees.push_back(randomTree(splits, facings, random));
  return forest;
}

// A lumpy figure of about the size of a person at 2.5 m, with missing measurements, in front of a wall that is not in
// the mask.
struct Scene {
  DepthImage depth;
  MaskImage mask;
};
inline Scene standingFigure(int width, int height, std::uint64_t seed) {
  Random random(seed);
  Scene scene{DepthImage(width, height, 4.0F), MaskImage(width, height, 0)};
  for (int y = height / 10; y < height - height / 10; ++y) {
    const int half = width / 12 + static_cast<int>(random.below(static_cast<std::uint32_t>(width / 40)));
    for (int x = width / 2 - half; x < width / 2 + half; ++x) {
      scene.mask.at(x, y) = 1;
      const double depth = 2.5 + 0.2 * std::sin(x * 0.05) * std::cos(y * 0.03) + random.uniform(0, 0.01);
      scene.depth.at(x, y) = random.below(50) == 0 ? 0.0F : static_cast<float>(depth);
    }
  }
  return scene;
}

}  // namespace depthmocap::test

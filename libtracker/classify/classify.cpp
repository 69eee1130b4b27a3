#include <algorithm>
#include <cstddef>

#include "libtracker/classify/descend.h"
#include "libtracker/classify/forest.h"
#include "libtracker/core/check.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

constexpr std::size_t kPixelsPerTask = 256;

using VoteSum = std::array<std::uint16_t, kPartCount>;  // up to 257 trees of 255 each
constexpr std::size_t kMaxTrees = 257;

void checkArguments(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px, int stride) {
  DMC_CHECK(!forest.trees.empty() && forest.trees.size() <= kMaxTrees);
  DMC_CHECK(depth.width == mask.width && depth.height == mask.height);
  DMC_CHECK(depth.width <= INT16_MAX && depth.height <= INT16_MAX);
  DMC_CHECK(focal_px >= 1 && focal_px <= 1e5);
  DMC_CHECK(stride >= 1);
}

void addLeaf(const std::array<std::uint8_t, kPartCount>& leaf, VoteSum& votes) {
  for (std::size_t part = 0; part < kPartCount; ++part) {
    votes[part] = static_cast<std::uint16_t>(votes[part] + leaf[part]);
  }
}

void setProbabilities(const VoteSum& votes, ClassifiedPixels::Pixel& pixel) {
  int total = 0;
  for (const std::uint16_t vote : votes) total += vote;
  const float share = 1.0F / static_cast<float>(std::max(total, 1));
  for (std::size_t part = 0; part < kPartCount; ++part)
    pixel.probability[part] = static_cast<float>(votes[part]) * share;
}

int firstOnGrid(int from, int stride) {
  return (from + stride - 1) / stride * stride;
}

void collectPixels(const DepthImage& depth, const MaskImage& mask, int stride, const ActorDepth& actor,
                   ClassifiedPixels& result) {
  result.stride = stride;
  result.pixels.clear();
  for (int y = firstOnGrid(actor.top, stride); y < actor.top + actor.height; y += stride) {
    for (int x = firstOnGrid(actor.left, stride); x < actor.left + actor.width; x += stride) {
      if (mask.at(x, y) == 0 || !(depth.at(x, y) > 0.0F)) continue;
      auto& pixel = result.pixels.emplace_back();
      pixel.x = static_cast<std::int16_t>(x);
      pixel.y = static_cast<std::int16_t>(y);
      pixel.depth_m = depth.at(x, y);
    }
  }
}

void classifyLanes(const Forest& forest, const ActorDepth& actor, double focal_px, Descend descend,
                   ClassifiedPixels::Pixel* pixels, std::size_t count) {
  PixelLanes lanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto& pixel = pixels[lane < count ? lane : 0];
    lanes.x[lane] = pixel.x - actor.left + 1;
    lanes.y[lane] = pixel.y - actor.top + 1;
    lanes.scale[lane] = probeScale(focal_px, pixel.depth_m);
  }
  std::array<VoteSum, kLanes> votes{};
  LeafLanes leaves;
  for (const ForestTree& tree : forest.trees) {
    descend(tree, actor, lanes, leaves);
    for (std::size_t lane = 0; lane < count; ++lane) {
      addLeaf(tree.leaves[static_cast<std::size_t>(leaves[lane])], votes[lane]);
    }
  }
  for (std::size_t lane = 0; lane < count; ++lane) setProbabilities(votes[lane], pixels[lane]);
}

}  // namespace

void classify(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
              const ClassifyConfig& config, ActorDepth& actor, ClassifiedPixels& result) {
  checkArguments(forest, depth, mask, focal_px, config.stride);
  cutOutActor(depth, mask, actor);
  collectPixels(depth, mask, config.stride, actor, result);
  const Descend descend = chooseDescend(config.simd);
  const std::size_t tasks = (result.pixels.size() + kPixelsPerTask - 1) / kPixelsPerTask;
  parallelFor(config.threads, tasks, [&](std::size_t task) {
    const std::size_t end = std::min(result.pixels.size(), (task + 1) * kPixelsPerTask);
    for (std::size_t i = task * kPixelsPerTask; i < end; i += kLanes) {
      classifyLanes(forest, actor, focal_px, descend, result.pixels.data() + i, std::min<std::size_t>(kLanes, end - i));
    }
  });
}

void classify(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
              const ClassifyConfig& config, ClassifiedPixels& result) {
  ActorDepth actor;
  classify(forest, depth, mask, focal_px, config, actor, result);
}

void classifyReference(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
                       int stride, ClassifiedPixels& result) {
  checkArguments(forest, depth, mask, focal_px, stride);
  const auto probe = [&](int x, int y) {
    const bool on_actor = depth.contains(x, y) && mask.at(x, y) != 0 && depth.at(x, y) > 0.0F;
    return on_actor ? depth.at(x, y) : kBackgroundDepth_m;
  };
  result.stride = stride;
  result.pixels.clear();
  for (int y = 0; y < depth.height; y += stride) {
    for (int x = 0; x < depth.width; x += stride) {
      if (mask.at(x, y) == 0 || !(depth.at(x, y) > 0.0F)) continue;
      const float scale = probeScale(focal_px, depth.at(x, y));
      const auto at_offset = [&](const std::array<std::int16_t, 2>& offset) {
        return probe(x + wholePixels(static_cast<float>(offset[0]) * scale),
                     y + wholePixels(static_cast<float>(offset[1]) * scale));
      };
      VoteSum votes{};
      for (const ForestTree& tree : forest.trees) {
        const ForestNode* node = tree.nodes.data();
        while (node->child > 0) {
          const bool left = at_offset(node->u) - at_offset(node->v) < node->threshold_m;
          node = &tree.nodes[static_cast<std::size_t>(node->child) + (left ? 0 : 1)];
        }
        addLeaf(tree.leaves[static_cast<std::size_t>(-node->child)], votes);
      }
      auto& pixel = result.pixels.emplace_back();
      pixel.x = static_cast<std::int16_t>(x);
      pixel.y = static_cast<std::int16_t>(y);
      pixel.depth_m = depth.at(x, y);
      setProbabilities(votes, pixel);
    }
  }
}

}  // namespace depthmocap

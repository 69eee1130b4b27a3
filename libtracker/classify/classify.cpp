#include "libtracker/classify/classify.h"

#include <algorithm>
#include <cstddef>

#include "libtracker/classify/decide_facing.h"
#include "libtracker/classify/descend.h"
#include "libtracker/classify/forest.h"
#include "libtracker/core/check.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

constexpr std::size_t kPixelsPerTask = 256;

using FacingVotes = std::array<VoteRow, kFacingCount>;  // up to 257 trees of 255 each
constexpr std::size_t kMaxTrees = 257;

void checkArguments(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px, int stride) {
  DMC_CHECK(forest.facings == 1 || forest.facings == kFacingCount);
  DMC_CHECK(!forest.trees.empty() && forest.trees.size() <= kMaxTrees);
  DMC_CHECK(depth.width == mask.width && depth.height == mask.height);
  DMC_CHECK(depth.width <= INT16_MAX && depth.height <= INT16_MAX);
  DMC_CHECK(focal_px >= 0.1 && focal_px <= 1e5);
  DMC_CHECK(stride >= 1);
}

void addLeaf(const ForestTree& tree, std::size_t leaf, std::size_t facings, FacingVotes& votes) {
  for (std::size_t facing = 0; facing < facings; ++facing) {
    const auto& row = tree.leaves[leaf * facings + facing];
    for (std::size_t part = 0; part < kPartLanes; ++part) {
      votes[facing][part] = static_cast<std::uint16_t>(votes[facing][part] + row[part]);
    }
  }
}

void prefetchLeaf(const ForestTree& tree, std::size_t leaf, std::size_t facings) {
  const auto* rows = tree.leaves.data() + leaf * facings;
  __builtin_prefetch(rows);
  __builtin_prefetch(rows + facings - 1);
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

void addVotes(const Forest& forest, const ActorDepth& actor, double focal_px, Descend descend,
              const ClassifiedPixels::Pixel* pixels, std::size_t count, FacingVotes* votes) {
  PixelLanes lanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const auto& pixel = pixels[lane < count ? lane : 0];
    lanes.x[lane] = pixel.x - actor.left + 1;
    lanes.y[lane] = pixel.y - actor.top + 1;
    lanes.scale[lane] = probeScale(focal_px, pixel.depth_m);
  }
  const auto facings = static_cast<std::size_t>(forest.facings);
  const auto add = [&](const ForestTree& tree, const LeafLanes& leaves) {
    for (std::size_t lane = 0; lane < count; ++lane) {
      addLeaf(tree, static_cast<std::size_t>(leaves[lane]), facings, votes[lane]);
    }
  };
  // The leaves of one tree come into the cache while the pixels go down the next.
  std::array<LeafLanes, 2> leaves;
  const std::size_t last = forest.trees.size() - 1;
  for (std::size_t t = 0; t <= last; ++t) {
    descend(forest.trees[t], actor, lanes, leaves[t % 2]);
    for (std::size_t lane = 0; lane < count; ++lane) {
      prefetchLeaf(forest.trees[t], static_cast<std::size_t>(leaves[t % 2][lane]), facings);
    }
    if (t > 0) add(forest.trees[t - 1], leaves[(t - 1) % 2]);
  }
  add(forest.trees[last], leaves[last % 2]);
}

template <typename Body>
void forEachTask(int threads, std::size_t pixels, Body&& body) {
  parallelFor(threads, (pixels + kPixelsPerTask - 1) / kPixelsPerTask, [&](std::size_t task) {
    body(task, task * kPixelsPerTask, std::min(pixels, (task + 1) * kPixelsPerTask));
  });
}

// From votes to probabilities; shared by the fast path and the reference.
void decide(const Forest& forest, const ClassifyConfig& config, ClassifyMemory& memory, ClassifiedPixels& result) {
  const std::size_t count = result.pixels.size();
  if (forest.facings == 1) {
    result.facing.fill(1.0F / kFacingCount);
    result.facing_by_image = result.facing;
  } else {
    memory.evidence.assign((count + kPixelsPerTask - 1) / kPixelsPerTask, {});
    forEachTask(config.threads, count, [&](std::size_t task, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) addEvidence(memory.votes[i], memory.evidence[task]);
    });
    result.facing = facingProbabilities(memory.evidence, count, config.facing_prior);
    result.facing_by_image = facingProbabilities(memory.evidence, count, ClassifyConfig{}.facing_prior);
  }
  assumeFacing(result.facing, config.threads, memory, result);
}

}  // namespace

void assumeFacing(const FacingShares& facing, int threads, const ClassifyMemory& memory, ClassifiedPixels& pixels) {
  DMC_CHECK(memory.votes.size() == pixels.pixels.size());
  pixels.facing = facing;
  forEachTask(threads, pixels.pixels.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      partProbabilities(memory.votes[i], facing, pixels.pixels[i].probability);
    }
  });
}

void classify(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
              const ClassifyConfig& config, ClassifyMemory& memory, ClassifiedPixels& result) {
  checkArguments(forest, depth, mask, focal_px, config.stride);
  cutOutActor(depth, mask, memory.actor);
  collectPixels(depth, mask, config.stride, memory.actor, result);
  memory.votes.assign(result.pixels.size(), {});
  const Descend descend = chooseDescend(config.simd);
  forEachTask(config.threads, result.pixels.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; i += kLanes) {
      addVotes(forest, memory.actor, focal_px, descend, result.pixels.data() + i,
               std::min<std::size_t>(kLanes, end - i), memory.votes.data() + i);
    }
  });
  decide(forest, config, memory, result);
}

void classify(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
              const ClassifyConfig& config, ClassifiedPixels& result) {
  ClassifyMemory memory;
  classify(forest, depth, mask, focal_px, config, memory, result);
}

void classifyReference(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
                       const ClassifyConfig& config, ClassifiedPixels& result) {
  checkArguments(forest, depth, mask, focal_px, config.stride);
  const auto probe = [&](int x, int y) {
    const bool on_actor = depth.contains(x, y) && mask.at(x, y) != 0 && depth.at(x, y) > 0.0F;
    return on_actor ? depth.at(x, y) : kBackgroundDepth_m;
  };
  const ActorDepth whole{0, 0, depth.width, depth.height, {}};
  collectPixels(depth, mask, config.stride, whole, result);
  ClassifyMemory memory;
  for (const auto& pixel : result.pixels) {
    const float scale = probeScale(focal_px, pixel.depth_m);
    const auto at_offset = [&](const std::array<std::int16_t, 2>& offset) {
      return probe(pixel.x + wholePixels(static_cast<float>(offset[0]) * scale),
                   pixel.y + wholePixels(static_cast<float>(offset[1]) * scale));
    };
    auto& votes = memory.votes.emplace_back();
    for (const ForestTree& tree : forest.trees) {
      const ForestNode* node = tree.nodes.data();
      while (node->child > 0) {
        const bool left = at_offset(node->u) - at_offset(node->v) < node->threshold_m;
        node = &tree.nodes[static_cast<std::size_t>(node->child) + (left ? 0 : 1)];
      }
      addLeaf(tree, static_cast<std::size_t>(-node->child), static_cast<std::size_t>(forest.facings), votes);
    }
  }
  decide(forest, config, memory, result);
}

}  // namespace depthmocap

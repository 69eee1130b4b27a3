#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/classify/actor_depth.h"
#include "libtracker/core/classified_pixels.h"
#include "libtracker/core/image.h"

namespace depthmocap {

// Random decision forest over depth-difference features (Shotton 2011):
//   f(x; u, v) = d(x + u/d(x)) - d(x + v/d(x)),  left where f < threshold.
// Offsets u, v are [px * m] for a focal length of kReferenceFocal_px; inference scales them by the camera's fx, so one
// forest serves every camera. A probe outside the actor (background, no measurement, outside the image) reads
// kBackgroundDepth_m.
inline constexpr float kReferenceFocal_px = 525.0F;
inline constexpr float kBackgroundDepth_m = 10.0F;

struct ForestNode {
  std::array<std::int16_t, 2> u{};  // [px * m] x, y
  std::array<std::int16_t, 2> v{};
  float threshold_m = 0;   // [m] a whole number of millimetres
  std::int32_t child = 0;  // > 0: index of the left child, the right one follows it; <= 0: -index of the leaf
};

// What a leaf says for one facing. Rows of leaves and of votes have one value more than there are parts, always 0, so
// that they fill whole vectors.
inline constexpr std::size_t kPartLanes = 16;
static_assert(kPartLanes > kPartCount);
using LeafRow = std::array<std::uint8_t, kPartLanes>;
using VoteRow = std::array<std::uint16_t, kPartLanes>;

struct ForestTree {
  std::vector<ForestNode> nodes;  // nodes[0] is the root
  // Each leaf has as many rows as the forest has facings: leaf i begins at leaves[i * facings]. Its rows together are
  // the distribution * 255 of part and facing, as if every facing were equally frequent.
  std::vector<LeafRow> leaves;
};

struct Forest {
  std::vector<ForestTree> trees;
  std::string origin;  // one line: data
  int facings = 1;     // kFacingCount, or 1: leaves do not tell the facings apart
};

// Throws std::logic_error where the forest is not one: no tree, no such number of facings, an index out of range, a
// node that is not reached exactly once from its root (so no cycle), a leaf without any probability.
void checkForest(const Forest& forest);

// loadForest throws Error (missing, not a forest, truncated, checksum, version, counts that do not fit together); no
// file makes it allocate more than its size justifies. saveForest writes the file whole or not at all; it numbers the
// nodes of each tree breadth-first and rounds thresholds to millimetres. The format is described in forest_layout.h.
Forest loadForest(const std::filesystem::path& path);
void saveForest(const Forest& forest, const std::filesystem::path& path);

// Nodes on the longest way from the root to a leaf, less one: 0 for a tree that is a single leaf.
int treeDepth(const ForestTree& tree);

struct ClassifyConfig {
  int stride = 2;    // [px] (>= 1) classify every stride-th pixel in x and y
  int threads = 1;   // (>= 1)
  bool simd = true;  // use the processor's vector instructions where it has them; the result is the same
  FacingShares facing_prior = {1, 1, 1, 1};  // (>= 0, not all 0) what is known of the facing before, at any scale
};

// Working memory of classify(), for reuse.
struct ClassifyMemory {
  ActorDepth actor;
  // What the trees say of each pixel: the sum of its leaves.
  std::vector<std::array<VoteRow, kFacingCount>> votes;
  std::vector<std::array<double, kFacingCount>> evidence;  // of some pixels each
};

// Classifies the pixels of the actor (mask != 0, with a measurement). `depth` and `mask` have the same size, `focal_px`
// is the camera's fx (1 .. 1e5). The same result for any number of threads. No allocation once `memory` and `result`
// have seen the largest actor.
//
// Beyond Shotton 2011: front and back of a person look much alike, and what is left from the front is right from
// behind. A pixel alone cannot decide that, but all pixels together can: leaves keep the joint distribution of part and
// facing, the image decides the facing, and each pixel's parts are taken from the distribution that fits.
void classify(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
              const ClassifyConfig& config, ClassifyMemory& memory, ClassifiedPixels& result);
// Every pixel's distribution again, as if the facings had these probabilities (>= 0, not all 0); `memory` and `pixels`
// as the last classify() left them.
void assumeFacing(const FacingShares& facing, int threads, const ClassifyMemory& memory, ClassifiedPixels& pixels);
// Every pixel's distribution again, as if the trees had seen exactly these parts (the size of the classified image; 0:
// any part) whatever the facing: what a perfect classifier would say, for measurements. The probabilities of the
// facings stay.
void labelAs(const PartImage& parts, int threads, ClassifyMemory& memory, ClassifiedPixels& pixels);
// classify() for a single image.
void classify(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
              const ClassifyConfig& config, ClassifiedPixels& result);

// The definition that classify() is tested against: the same result from the plain images, pixel by pixel, slowly.
void classifyReference(const Forest& forest, const DepthImage& depth, const MaskImage& mask, double focal_px,
                       const ClassifyConfig& config, ClassifiedPixels& result);

// The most probable part (index 0 .. 14, the first of equals) of a classified pixel.
int mostProbablePart(const ClassifiedPixels::Pixel& pixel);

// The most probable part of each pixel of the mask; pixels between classified ones take the nearest one's.
void labelImage(const ClassifiedPixels& pixels, const MaskImage& mask, PartImage& labels);

}  // namespace depthmocap

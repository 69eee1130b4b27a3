#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "depthmocap/parts.h"
#include "libtracker/core/facing.h"
#include "libtracker/core/random.h"

namespace depthmocap {

using PartCounts = std::array<std::uint32_t, kPartCount>;

// What a split is to tell apart: the part, and the side from which the actor is seen.
inline constexpr int kClassesPerFacing = 16;  // kPartCount and one unused
inline constexpr int kClassCount = kFacingCount * kClassesPerFacing;
using ClassCounts = std::array<std::uint32_t, kClassCount>;
constexpr std::uint8_t classIndex(Facing facing, int part_index) {
  return static_cast<std::uint8_t>(static_cast<int>(facing) * kClassesPerFacing + part_index);
}

// [px * m] an offset of a feature.
using ProbeOffset = std::array<std::int16_t, 2>;

// What features are drawn from.
struct FeatureOptions {
  int offsets = 256;           // (>= 2) probes of one level; features are pairs of them
  double min_offset = 2.0;     // [px * m] (> 0)
  double max_offset = 1000.0;  // [px * m] (> min_offset, < 32767)
  double center_share = 0.4;   // [0, 1] share of features with one probe on the pixel itself
};

// Offsets of one level: the first is the pixel itself, the others have a random direction and a log-uniform length.
std::vector<ProbeOffset> drawOffsets(const FeatureOptions& options, Random& random);

// d(first) - d(second) + jitter, both offsets by their place in the level's list. The jitter shifts the common
// thresholds.
struct CandidateFeature {
  std::uint16_t first = 0;
  std::uint16_t second = 0;
  std::int16_t jitter_mm = 0;
};
CandidateFeature drawCandidate(const FeatureOptions& options, Random& random);

// Feature values fall into bins whose edges are the candidate thresholds.
inline constexpr int kBinCount = 32;
int thresholdMillimetres(int bin, const CandidateFeature& feature);  // between `bin` and `bin` + 1

// How many samples of each class fall into each bin, for a list of features: [feature][bin][kClassCount]. Sums over
// samples: histograms of disjoint sets of samples add up.
class SplitHistogram {
 public:
  void reset(std::span<const CandidateFeature> features);
  // `probes_mm`: the depth at every offset of the level for one sample.
  void add(const std::uint16_t* probes_mm, std::uint8_t class_index);
  [[nodiscard]] std::span<const std::uint32_t> counts() const { return counts_; }

 private:
  std::vector<CandidateFeature> features_;
  std::vector<std::uint32_t> counts_;
};

// n log2(n) in fixed point, so that sums are exact and no tie depends on the order of addition.
class EntropyTable {
 public:
  explicit EntropyTable(std::size_t size);
  [[nodiscard]] std::int64_t operator()(std::uint32_t n) const { return n < table_.size() ? table_[n] : compute(n); }
  static constexpr double kOne = 1 << 20;  // one bit

 private:
  static std::int64_t compute(std::uint32_t n);
  std::vector<std::int64_t> table_;
};

struct Split {
  std::int64_t gain = -1;  // [bit * sample / (8 EntropyTable::kOne)]; < 0: none is possible
  std::uint32_t feature = 0;
  int bin = 0;  // left: bins up to this one
};

// The threshold of one feature's histogram that lowers H(part | facing) + facing_weight / 8 H(facing) most, with at
// least `min_leaf` samples on each side.
Split bestThreshold(const std::uint32_t* histogram, const ClassCounts& total, std::uint32_t min_leaf, int facing_weight,
                    const EntropyTable& entropy);

}  // namespace depthmocap

#include "forest/train/split_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

// Feature values [mm] plus kShift_mm are looked up in steps of kStep_mm.
constexpr int kStep_mm = 8;
constexpr int kShift_mm = 10240;
constexpr int kMaxJitter_mm = 16;

// Edges [steps of kStep_mm], fine about zero where surfaces differ, coarse towards the background.
constexpr std::array<int, kBinCount - 1> kEdges = {-700, -400, -220, -140, -90, -60, -40, -27, -18, -12, -8,
                                                   -5,   -3,   -2,   -1,   0,   1,   2,   3,   5,   8,   12,
                                                   18,   27,   40,   60,   90,  140, 220, 400, 700};

constexpr std::size_t kLookupSize = 2 * kShift_mm / kStep_mm;

std::array<std::uint8_t, kLookupSize> makeLookup() {
  std::array<std::uint8_t, kLookupSize> lookup{};
  for (std::size_t i = 0; i < kLookupSize; ++i) {
    const int step = static_cast<int>(i) - kShift_mm / kStep_mm;
    lookup[i] = static_cast<std::uint8_t>(std::upper_bound(kEdges.begin(), kEdges.end(), step) - kEdges.begin());
  }
  return lookup;
}
const std::array<std::uint8_t, kLookupSize> kLookup = makeLookup();

}  // namespace

std::vector<ProbeOffset> drawOffsets(const FeatureOptions& options, Random& random) {
  std::vector<ProbeOffset> offsets(static_cast<std::size_t>(options.offsets));
  const double span = std::log(options.max_offset / options.min_offset);
  for (std::size_t i = 1; i < offsets.size(); ++i) {
    const double length = options.min_offset * std::exp(span * random.uniform());
    const double angle = random.uniform(0, 2 * std::numbers::pi);
    offsets[i] = {static_cast<std::int16_t>(std::lround(length * std::cos(angle))),
                  static_cast<std::int16_t>(std::lround(length * std::sin(angle)))};
  }
  return offsets;
}

CandidateFeature drawCandidate(const FeatureOptions& options, Random& random) {
  const auto others = static_cast<std::uint32_t>(options.offsets - 1);
  const auto other = [&] { return static_cast<std::uint16_t>(1 + random.below(others)); };
  const bool center = random.uniform() < options.center_share;
  CandidateFeature feature;
  feature.first = other();
  feature.second = center ? std::uint16_t{0} : other();
  feature.jitter_mm = static_cast<std::int16_t>(static_cast<int>(random.below(2 * kMaxJitter_mm + 1)) - kMaxJitter_mm);
  return feature;
}

int thresholdMillimetres(int bin, const CandidateFeature& feature) {
  return kEdges[static_cast<std::size_t>(bin)] * kStep_mm - feature.jitter_mm;
}

void SplitHistogram::reset(std::span<const CandidateFeature> features) {
  features_.assign(features.begin(), features.end());
  counts_.assign(features.size() * kBinCount * kClassCount, 0);
}

void SplitHistogram::add(const std::uint16_t* probes_mm, std::uint8_t class_index) {
  std::uint32_t* counts = counts_.data() + class_index;
  for (const CandidateFeature& feature : features_) {
    const int value = probes_mm[feature.first] - probes_mm[feature.second] + feature.jitter_mm;
    const auto bin = kLookup[static_cast<std::size_t>((value + kShift_mm) / kStep_mm)];
    ++counts[std::size_t{bin} * kClassCount];
    counts += kBinCount * kClassCount;
  }
}

EntropyTable::EntropyTable(std::size_t size) : table_(size) {
  for (std::size_t n = 0; n < size; ++n) table_[n] = compute(static_cast<std::uint32_t>(n));
}

std::int64_t EntropyTable::compute(std::uint32_t n) {
  return n < 2 ? 0 : std::llround(n * std::log2(n) * kOne);
}

namespace {

// The samples on one side of a threshold, and the sums of n log n over them.
struct Side {
  ClassCounts of_class{};
  std::array<std::uint32_t, kFacingCount> of_facing{};
  std::uint32_t all = 0;
};

}  // namespace

Split bestThreshold(const std::uint32_t* histogram, const ClassCounts& total, std::uint32_t min_leaf, int facing_weight,
                    const EntropyTable& entropy) {
  Side left, right;
  std::int64_t classes = 0;  // sums of n log n over the classes and facings of both sides
  std::int64_t facings = 0;
  for (std::size_t c = 0; c < kClassCount; ++c) {
    right.of_class[c] = total[c];
    right.of_facing[c / kClassesPerFacing] += total[c];
    right.all += total[c];
    classes += entropy(total[c]);
  }
  for (const std::uint32_t n : right.of_facing) facings += entropy(n);
  const auto score = [&] {
    return 8 * (classes - facings) + facing_weight * (facings - entropy(left.all) - entropy(right.all));
  };
  const std::int64_t before = score();
  Split best;
  for (int bin = 0; bin < kBinCount - 1; ++bin, histogram += kClassCount) {
    const std::uint32_t left_before = left.all;
    for (std::size_t f = 0; f < kFacingCount; ++f) {
      std::uint32_t moved = 0;
      for (std::size_t c = f * kClassesPerFacing; c < f * kClassesPerFacing + kPartCount; ++c) {
        const std::uint32_t n = histogram[c];
        if (n == 0) continue;
        classes -= entropy(left.of_class[c]) + entropy(right.of_class[c]);
        left.of_class[c] += n;
        right.of_class[c] -= n;
        classes += entropy(left.of_class[c]) + entropy(right.of_class[c]);
        moved += n;
      }
      if (moved == 0) continue;
      facings -= entropy(left.of_facing[f]) + entropy(right.of_facing[f]);
      left.of_facing[f] += moved;
      right.of_facing[f] -= moved;
      facings += entropy(left.of_facing[f]) + entropy(right.of_facing[f]);
      left.all += moved;
      right.all -= moved;
    }
    if (left.all == left_before || left.all < min_leaf || right.all < min_leaf) continue;
    const std::int64_t gain = score() - before;
    if (gain > best.gain) best = {gain, 0, bin};
  }
  return best;
}

}  // namespace depthmocap

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
  counts_.assign(features.size() * kBinCount * kHistogramParts, 0);
}

void SplitHistogram::add(const std::uint16_t* probes_mm, std::uint8_t part_index) {
  std::uint32_t* counts = counts_.data() + part_index;
  for (const CandidateFeature& feature : features_) {
    const int value = probes_mm[feature.first] - probes_mm[feature.second] + feature.jitter_mm;
    const auto bin = kLookup[static_cast<std::size_t>((value + kShift_mm) / kStep_mm)];
    ++counts[std::size_t{bin} * kHistogramParts];
    counts += kBinCount * kHistogramParts;
  }
}

EntropyTable::EntropyTable(std::size_t size) : table_(size) {
  for (std::size_t n = 0; n < size; ++n) table_[n] = compute(static_cast<std::uint32_t>(n));
}

std::int64_t EntropyTable::compute(std::uint32_t n) {
  return n < 2 ? 0 : std::llround(n * std::log2(n) * kOne);
}

Split bestThreshold(const std::uint32_t* histogram, const PartCounts& total, std::uint32_t min_leaf,
                    const EntropyTable& entropy) {
  PartCounts left{};
  PartCounts right = total;
  const std::uint32_t all = std::accumulate(total.begin(), total.end(), 0U);
  std::int64_t parts = 0;  // sum of n log n over the parts of both sides
  for (const std::uint32_t n : total) parts += entropy(n);
  const std::int64_t before = parts - entropy(all);
  std::uint32_t left_count = 0;
  Split best;
  for (int bin = 0; bin < kBinCount - 1; ++bin, histogram += kHistogramParts) {
    const std::uint32_t left_before = left_count;
    for (std::size_t part = 0; part < kPartCount; ++part) {
      const std::uint32_t n = histogram[part];
      if (n == 0) continue;
      parts -= entropy(left[part]) + entropy(right[part]);
      left[part] += n;
      right[part] -= n;
      parts += entropy(left[part]) + entropy(right[part]);
      left_count += n;
    }
    if (left_count == left_before || left_count < min_leaf || all - left_count < min_leaf) continue;
    const std::int64_t gain = parts - entropy(left_count) - entropy(all - left_count) - before;
    if (gain > best.gain) best = {gain, 0, bin};
  }
  return best;
}

}  // namespace depthmocap

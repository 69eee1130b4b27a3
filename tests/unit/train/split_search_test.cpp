#include "forest/train/split_search.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

struct TestSample {
  std::array<std::uint16_t, 2> probes_mm;
  std::uint8_t part;
};

std::vector<TestSample> randomSamples(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<TestSample> samples(count);
  for (TestSample& s : samples) {
    const auto probe = [&] {
      return static_cast<std::uint16_t>(random.below(4) == 0 ? 10000 : 2000 + random.below(800));
    };
    s = {{probe(), probe()}, static_cast<std::uint8_t>(random.below(kPartCount))};
  }
  return samples;
}

double entropyOf(const PartCounts& counts) {
  double all = 0, sum = 0;
  for (const auto n : counts) all += n;
  for (const double n : counts) sum -= n > 0 ? n * std::log2(n / all) : 0.0;
  return sum;  // [bit * sample]
}

TEST(SplitSearch, GainIsTheDropOfEntropyAtTheThreshold) {
  const auto samples = randomSamples(3000, 1);
  const CandidateFeature feature{0, 1, 5};
  SplitHistogram histogram;
  histogram.reset({&feature, 1});
  PartCounts total{};
  for (const auto& s : samples) {
    histogram.add(s.probes_mm.data(), s.part);
    ++total[s.part];
  }
  const Split split = bestThreshold(histogram.of(0), total, 1, EntropyTable(100));
  ASSERT_GT(split.gain, 0);
  double best = 0;
  for (int bin = 0; bin < kBinCount - 1; ++bin) {
    PartCounts left{}, right{};
    for (const auto& s : samples) {
      const bool is_left = s.probes_mm[0] - s.probes_mm[1] < thresholdMillimetres(bin, feature);
      ++(is_left ? left : right)[s.part];
    }
    const double gain = entropyOf(total) - entropyOf(left) - entropyOf(right);
    if (bin == split.bin) {
      EXPECT_NEAR(static_cast<double>(split.gain) / EntropyTable::kOne, gain, 1e-3);
    }
    best = std::max(best, gain);
  }
  EXPECT_NEAR(static_cast<double>(split.gain) / EntropyTable::kOne, best, 1e-3);
}

TEST(SplitSearch, HistogramsOfDisjointSamplesAddUp) {
  const auto samples = randomSamples(500, 2);
  const CandidateFeature feature{1, 0, -3};
  SplitHistogram whole, first, second;
  for (auto* h : {&whole, &first, &second}) h->reset({&feature, 1});
  for (std::size_t i = 0; i < samples.size(); ++i) {
    whole.add(samples[i].probes_mm.data(), samples[i].part);
    (i < 200 ? first : second).add(samples[i].probes_mm.data(), samples[i].part);
  }
  for (int i = 0; i < kBinCount * kHistogramParts; ++i) EXPECT_EQ(whole.of(0)[i], first.of(0)[i] + second.of(0)[i]);
}

TEST(SplitSearch, NoSplitWhereASideWouldBeTooSmall) {
  SplitHistogram histogram;
  const CandidateFeature feature{0, 1, 0};
  histogram.reset({&feature, 1});
  PartCounts total{};
  for (int i = 0; i < 20; ++i) {
    const std::array<std::uint16_t, 2> probes = {static_cast<std::uint16_t>(i < 5 ? 2000 : 3000), 2500};
    histogram.add(probes.data(), i < 5 ? 0 : 1);
    ++total[i < 5 ? 0 : 1];
  }
  EXPECT_GT(bestThreshold(histogram.of(0), total, 5, EntropyTable(64)).gain, 0);
  EXPECT_LT(bestThreshold(histogram.of(0), total, 6, EntropyTable(64)).gain, 0);
}

TEST(SplitSearch, OffsetsCoverTheirRange) {
  Random random(3);
  FeatureOptions options;
  options.offsets = 2000;
  const auto offsets = drawOffsets(options, random);
  EXPECT_EQ(offsets[0], (ProbeOffset{0, 0}));
  int short_ones = 0, right_ones = 0;
  for (std::size_t i = 1; i < offsets.size(); ++i) {
    const double length = std::hypot(offsets[i][0], offsets[i][1]);
    EXPECT_GE(length, options.min_offset - 1);
    EXPECT_LE(length, options.max_offset + 1);
    if (length < std::sqrt(options.min_offset * options.max_offset)) ++short_ones;
    if (offsets[i][0] > 0) ++right_ones;
  }
  EXPECT_NEAR(short_ones, 1000, 150);  // log-uniform
  EXPECT_NEAR(right_ones, 1000, 150);
}

TEST(SplitSearch, CandidatesAreSpreadOverTheOffsets) {
  FeatureOptions options;
  options.offsets = 17;
  std::array<int, 17> seen{};
  int center = 0;
  for (std::uint64_t f = 0; f < 3200; ++f) {
    Random random(f, 77);
    const CandidateFeature feature = drawCandidate(options, random);
    ++seen[feature.first];
    center += feature.second == 0 ? 1 : 0;
  }
  EXPECT_EQ(seen[0], 0);
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_NEAR(seen[i], 200, 60);
  EXPECT_NEAR(center, 3200 * options.center_share, 160);
}

}  // namespace
}  // namespace depthmocap

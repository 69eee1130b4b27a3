#include "forest/train/split_search.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

struct TestSample {
  std::array<std::uint16_t, 2> probes_mm;
  int part;
  Facing facing;

  [[nodiscard]] std::uint8_t classOf() const { return classIndex(facing, part); }
};

std::vector<TestSample> randomSamples(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<TestSample> samples(count);
  for (TestSample& s : samples) {
    const auto probe = [&] {
      return static_cast<std::uint16_t>(random.below(4) == 0 ? 10000 : 2000 + random.below(800));
    };
    s = {{probe(), probe()},
         static_cast<int>(random.below(kPartCount)),
         static_cast<Facing>(random.below(kFacingCount))};
  }
  return samples;
}

// [bit * sample]
template <typename Counts>
double entropyOf(const Counts& counts) {
  double all = 0, sum = 0;
  for (const auto n : counts) all += n;
  for (const double n : counts) sum -= n > 0 ? n * std::log2(n / all) : 0.0;
  return sum;
}

// H(part | facing) + weight / 8 H(facing).
double impurityOf(const ClassCounts& counts, int weight) {
  std::array<double, kFacingCount> facings{};
  double sum = 0;
  for (std::size_t f = 0; f < kFacingCount; ++f) {
    const auto of_facing = std::span(counts).subspan(f * kClassesPerFacing, kClassesPerFacing);
    for (const auto n : of_facing) facings[f] += n;
    sum += entropyOf(of_facing);
  }
  return sum + weight / 8.0 * entropyOf(facings);
}

TEST(SplitSearch, GainIsTheDropOfImpurityAtTheThreshold) {
  const auto samples = randomSamples(3000, 1);
  const CandidateFeature feature{0, 1, 5};
  SplitHistogram histogram;
  histogram.reset({&feature, 1});
  ClassCounts total{};
  for (const auto& s : samples) {
    histogram.add(s.probes_mm.data(), s.classOf());
    ++total[s.classOf()];
  }
  for (const int weight : {0, 3, 8}) {
    const Split split = bestThreshold(histogram.counts().data(), total, 1, weight, EntropyTable(100));
    ASSERT_GT(split.gain, 0);
    const double found = static_cast<double>(split.gain) / 8 / EntropyTable::kOne;
    double best = 0;
    for (int bin = 0; bin < kBinCount - 1; ++bin) {
      ClassCounts left{}, right{};
      for (const auto& s : samples) {
        const bool is_left = s.probes_mm[0] - s.probes_mm[1] < thresholdMillimetres(bin, feature);
        ++(is_left ? left : right)[s.classOf()];
      }
      const double gain = impurityOf(total, weight) - impurityOf(left, weight) - impurityOf(right, weight);
      if (bin == split.bin) {
        EXPECT_NEAR(found, gain, 1e-3);
      }
      best = std::max(best, gain);
    }
    EXPECT_NEAR(found, best, 1e-3);
  }
}

TEST(SplitSearch, HistogramsOfDisjointSamplesAddUp) {
  const auto samples = randomSamples(500, 2);
  const CandidateFeature feature{1, 0, -3};
  SplitHistogram whole, first, second;
  for (auto* h : {&whole, &first, &second}) h->reset({&feature, 1});
  for (std::size_t i = 0; i < samples.size(); ++i) {
    whole.add(samples[i].probes_mm.data(), samples[i].classOf());
    (i < 200 ? first : second).add(samples[i].probes_mm.data(), samples[i].classOf());
  }
  for (std::size_t i = 0; i < whole.counts().size(); ++i) {
    EXPECT_EQ(whole.counts()[i], first.counts()[i] + second.counts()[i]);
  }
}

TEST(SplitSearch, NoSplitWhereASideWouldBeTooSmall) {
  SplitHistogram histogram;
  const CandidateFeature feature{0, 1, 0};
  histogram.reset({&feature, 1});
  ClassCounts total{};
  for (int i = 0; i < 20; ++i) {
    const std::array<std::uint16_t, 2> probes = {static_cast<std::uint16_t>(i < 5 ? 2000 : 3000), 2500};
    histogram.add(probes.data(), i < 5 ? 0 : 1);
    ++total[i < 5 ? 0 : 1];
  }
  EXPECT_GT(bestThreshold(histogram.counts().data(), total, 5, 8, EntropyTable(64)).gain, 0);
  EXPECT_LT(bestThreshold(histogram.counts().data(), total, 6, 8, EntropyTable(64)).gain, 0);
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

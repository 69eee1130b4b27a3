#include "libtracker/smooth/look_ahead_smoother.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

using Sample = LookAheadSmoother::Sample;

constexpr double kFrame_s = 1.0 / 30.0;
constexpr double kHalfWidth_s = 0.13;

// Poses given one by one, as many as samples.
std::vector<Pose> smoothed(const std::vector<Sample>& samples, double half_width_s = kHalfWidth_s) {
  LookAheadSmoother smoother(half_width_s);
  std::vector<Pose> result;
  const auto take = [&] {
    while (const auto q = smoother.next()) result.push_back(*q);
  };
  for (const Sample& sample : samples) {
    smoother.add(sample);
    take();
  }
  smoother.finish();
  take();
  EXPECT_EQ(result.size(), samples.size());
  return result;
}

// A track of q(time).
template <typename Motion>
std::vector<Sample> track(int frames, Motion q) {
  std::vector<Sample> samples;
  for (int i = 0; i < frames; ++i) samples.push_back({i * kFrame_s, q(i * kFrame_s), i > 0});
  return samples;
}

std::vector<Sample> noise(int frames) {
  Random random(5);
  return track(frames, [&](double) {
    Pose q;
    for (int d = 0; d < kDofCount; ++d) q[d] = random.normal();
    return q;
  });
}

double rms(const std::vector<Pose>& poses) {
  double sum = 0;
  for (const Pose& q : poses) sum += q.squaredNorm() / kDofCount;
  return std::sqrt(sum / static_cast<double>(poses.size()));
}

TEST(LookAheadSmoother, KeepsSteadyAccelerationFromTheFirstFrameToTheLast) {
  auto samples = track(20, [](double t) -> Pose { return Pose::Constant(0.3 + 2.0 * t - 5.0 * t * t); });
  for (const std::size_t i : {4U, 7U, 15U}) samples[i].time_s += 0.009;  // frames do not come regularly
  for (Sample& s : samples) s.q = Pose::Constant(0.3 + 2.0 * s.time_s - 5.0 * s.time_s * s.time_s);
  samples.erase(samples.begin() + 10);
  const auto poses = smoothed(samples);
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_LT((poses[i] - samples[i].q).norm(), 1e-12) << i;
}

TEST(LookAheadSmoother, LowersNoiseAndMoreSoWithAWiderWindow) {
  const auto samples = noise(300);
  double before = 0.8;
  for (const double half_width_s : {kHalfWidth_s, 2 * kHalfWidth_s, 4 * kHalfWidth_s}) {
    const double after = rms(smoothed(samples, half_width_s));
    EXPECT_LT(after, before) << half_width_s;
    before = 0.85 * after;
  }
}

TEST(LookAheadSmoother, OffGivesEachPoseAtOnceAsItIs) {
  const auto samples = noise(5);
  LookAheadSmoother off(0);
  for (const Sample& sample : samples) {
    off.add(sample);
    EXPECT_EQ(off.next(), sample.q);
    EXPECT_FALSE(off.next());
  }
}

TEST(LookAheadSmoother, WaitsForTheWindowOnly) {
  LookAheadSmoother smoother(kHalfWidth_s);
  const auto samples = noise(100);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    smoother.add(samples[i]);
    EXPECT_EQ(smoother.next().has_value(), i >= 4) << i;  // the fifth is out of the first one's window
  }
}

TEST(LookAheadSmoother, WaitsForAFewFramesOnlyHoweverDenseTheyAre) {
  LookAheadSmoother smoother(1.0);
  int given = 0;
  for (int i = 0; i < 1000; ++i) {
    smoother.add({i * 1e-6, Pose::Constant(i), i > 0});
    given += smoother.next() ? 1 : 0;
  }
  EXPECT_GT(given, 900);
}

TEST(LookAheadSmoother, AFrameThatDoesNotGoOnIsABorder) {
  auto samples = noise(40);
  const std::vector<Sample> second(samples.begin() + 17, samples.end());
  samples[17].joined = false;
  const auto poses = smoothed(samples);
  const auto first_alone = smoothed({samples.begin(), samples.begin() + 17});
  const auto second_alone = smoothed(second);
  for (std::size_t i = 0; i < 17; ++i) EXPECT_EQ(poses[i], first_alone[i]) << i;
  for (std::size_t i = 17; i < 40; ++i) EXPECT_LT((poses[i] - second_alone[i - 17]).norm(), 1e-12) << i;
}

TEST(LookAheadSmoother, AFrameOfNoTrackStaysAsItIs) {
  auto samples = noise(20);
  samples[9].joined = samples[10].joined = false;
  EXPECT_EQ(smoothed(samples)[9], samples[9].q);
}

TEST(LookAheadSmoother, HeadingTurnsThroughTheBackWithoutABackSpin) {
  const auto heading = [](double t) { return 2.5 + 1.5 * t; };
  const auto samples = track(60, [&](double t) {
    Pose q = Pose::Zero();
    q[kRootRy] = std::remainder(heading(t), 2.0 * std::numbers::pi);
    return q;
  });
  const auto poses = smoothed(samples);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(std::remainder(poses[i][kRootRy] - heading(samples[i].time_s), 2.0 * std::numbers::pi), 0, 1e-9) << i;
  }
}

TEST(LookAheadSmoother, AWaveIsNotLate) {
  const auto samples = track(90, [](double t) -> Pose { return Pose::Constant(std::sin(2.0 * std::numbers::pi * t)); });
  const auto poses = smoothed(samples);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_NEAR(poses[i][0], samples[i].q[0], 0.004) << i;
}

}  // namespace
}  // namespace depthmocap

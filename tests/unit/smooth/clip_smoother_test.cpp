#include "libtracker/smooth/clip_smoother.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

using Sample = ClipSmoother::Sample;

constexpr double kFrame_s = 1.0 / 30.0;
constexpr double kReach_s = 0.3;

NormalEquations evidenceOf(double k) {
  NormalEquations evidence;
  evidence.A.diagonal().setConstant(k);
  return evidence;
}

// Poses given one by one, as many as samples.
std::vector<Pose> smoothed(const std::vector<Sample>& samples, double reach_s = kReach_s) {
  ClipSmoother smoother(reach_s);
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

// A track whose root is at x(time), the rest of the body at rest; each frame sees all of it with weight `k`.
template <typename Motion>
std::vector<Sample> track(int frames, Motion x, double k = 10000.0) {
  std::vector<Sample> samples;
  for (int i = 0; i < frames; ++i) {
    Pose q = Pose::Zero();
    q[kRootTx] = x(i * kFrame_s);
    samples.push_back({i * kFrame_s, q, i > 0, evidenceOf(k)});
  }
  return samples;
}

std::vector<Sample> noise(int frames) {
  Random random(5);
  return track(frames, [&](double) { return random.normal(); });
}

double rms(const std::vector<Pose>& poses) {
  double sum = 0;
  for (const Pose& q : poses) sum += q[kRootTx] * q[kRootTx];
  return std::sqrt(sum / static_cast<double>(poses.size()));
}

TEST(ClipSmoother, KeepsSteadyVelocityAtUnevenTimes) {
  auto samples = track(50, [](double) { return 0.0; });
  for (const std::size_t i : {4U, 7U, 15U}) samples[i].time_s += 0.009;
  for (Sample& s : samples) s.q[kRootTx] = 0.3 + 2.0 * s.time_s;
  samples.erase(samples.begin() + 10);
  const auto poses = smoothed(samples);
  // The frame's own hold on what nothing sees is all that keeps this from being exact.
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_LT((poses[i] - samples[i].q).norm(), 1e-9) << i;
}

TEST(ClipSmoother, LowersNoiseTheMoreTheLessTheEvidenceWeighs) {
  auto samples = noise(300);
  double before = 0.9;
  for (const double k : {100000.0, 10000.0, 1000.0}) {
    for (Sample& sample : samples) sample.evidence = evidenceOf(k);
    const double after = rms(smoothed(samples));
    EXPECT_LT(after, before) << k;
    before = 0.85 * after;
  }
}

// The middle third of the frames says nothing: the pose comes from both sides.
TEST(ClipSmoother, WhatIsHiddenComesFromBothSides) {
  auto samples = track(30, [](double t) { return 1.5 * t; });
  for (std::size_t i = 10; i < 20; ++i) {
    samples[i].evidence = evidenceOf(0);
    samples[i].q[kRootTx] += 0.4;  // a guess
  }
  const auto poses = smoothed(samples, 1.0);
  for (std::size_t i = 0; i < 30; ++i) EXPECT_NEAR(poses[i][kRootTx], 1.5 * samples[i].time_s, 0.02) << i;
}

// The evidence's slope moves the pose to where the frame alone would have it.
TEST(ClipSmoother, GoesWhereTheEvidencePoints) {
  auto samples = track(30, [](double) { return 0.0; });
  for (Sample& sample : samples) sample.evidence.g[kRootTx] = -1000.0;  // minimum at 0.1
  for (const Pose& q : smoothed(samples)) EXPECT_NEAR(q[kRootTx], 0.1, 1e-4);
}

TEST(ClipSmoother, PiecesMeetWithoutASeam) {
  const auto samples = noise(200);
  const auto piecewise = smoothed(samples, 1.0);
  const auto at_once = smoothed(samples, 100.0);
  for (std::size_t i = 0; i < samples.size(); ++i) EXPECT_NEAR(piecewise[i][kRootTx], at_once[i][kRootTx], 1e-3) << i;
}

TEST(ClipSmoother, OffGivesEachPoseAtOnceAsItIs) {
  ClipSmoother off(0);
  for (const Sample& sample : noise(5)) {
    off.add(sample);
    EXPECT_EQ(off.next(), sample.q);
    EXPECT_FALSE(off.next());
  }
}

TEST(ClipSmoother, WaitsForAPieceAndItsContextOnly) {
  ClipSmoother smoother(kReach_s);
  std::size_t given = 0;
  const auto samples = noise(100);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    smoother.add(samples[i]);
    while (smoother.next()) ++given;
    EXPECT_LE(i - given, 20U) << i;
  }
}

TEST(ClipSmoother, WaitsForAFewFramesOnlyHoweverDenseTheyAre) {
  ClipSmoother smoother(1.0);
  int given = 0;
  for (int i = 0; i < 1000; ++i) {
    smoother.add({i * 1e-6, Pose::Zero(), i > 0, evidenceOf(1)});
    while (smoother.next()) ++given;
  }
  EXPECT_GT(given, 850);
}

TEST(ClipSmoother, AFrameThatDoesNotGoOnIsABorder) {
  auto samples = noise(40);
  const std::vector<Sample> second(samples.begin() + 17, samples.end());
  samples[17].joined = false;
  const auto poses = smoothed(samples);
  const auto first_alone = smoothed({samples.begin(), samples.begin() + 17});
  const auto second_alone = smoothed(second);
  for (std::size_t i = 0; i < 17; ++i) EXPECT_NEAR(poses[i][kRootTx], first_alone[i][kRootTx], 1e-3) << i;
  for (std::size_t i = 17; i < 40; ++i) EXPECT_NEAR(poses[i][kRootTx], second_alone[i - 17][kRootTx], 1e-3) << i;
}

TEST(ClipSmoother, AFrameOfNoTrackStaysAsItIs) {
  auto samples = noise(20);
  samples[9].joined = samples[10].joined = false;
  EXPECT_EQ(smoothed(samples)[9], samples[9].q);
}

TEST(ClipSmoother, HeadingTurnsThroughTheBackWithoutABackSpin) {
  const auto heading = [](double t) { return 2.5 + 1.5 * t; };
  auto samples = track(60, [](double) { return 0.0; });
  for (Sample& s : samples) s.q[kRootRy] = std::remainder(heading(s.time_s), 2.0 * std::numbers::pi);
  const auto poses = smoothed(samples);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_NEAR(std::remainder(poses[i][kRootRy] - heading(samples[i].time_s), 2.0 * std::numbers::pi), 0, 1e-9) << i;
    EXPECT_LE(std::abs(poses[i][kRootRy]), std::numbers::pi);
  }
}

TEST(ClipSmoother, AWaveIsNotLate) {
  const auto samples = track(
      90, [](double t) { return std::sin(2.0 * std::numbers::pi * t); }, 100000.0);
  const auto poses = smoothed(samples);
  for (std::size_t i = 0; i < poses.size(); ++i) EXPECT_NEAR(poses[i][kRootTx], samples[i].q[kRootTx], 0.01) << i;
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/session/durations.h"

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

Durations filled(Durations::Keep keep) {
  Durations durations(keep);
  for (int i = 1000; i >= 1; --i) durations.add(0.1 * i);
  return durations;
}

TEST(Durations, AllAreExact) {
  const Durations::Summary s = filled(Durations::Keep::All).summary();
  EXPECT_DOUBLE_EQ(s.p50, 0.1 * 501);
  EXPECT_DOUBLE_EQ(s.p95, 0.1 * 950);
  EXPECT_DOUBLE_EQ(s.p99, 0.1 * 990);
  EXPECT_NEAR(s.mean, 50.05, 1e-9);
}

TEST(Durations, BinnedAreWithinHalfAPercent) {
  const Durations::Summary exact = filled(Durations::Keep::All).summary();
  const Durations::Summary s = filled(Durations::Keep::Binned).summary();
  EXPECT_NEAR(s.p50, exact.p50, 0.0051 * exact.p50);
  EXPECT_NEAR(s.p95, exact.p95, 0.0051 * exact.p95);
  EXPECT_NEAR(s.p99, exact.p99, 0.0051 * exact.p99);
  EXPECT_NEAR(s.mean, exact.mean, 1e-9);
}

TEST(Durations, WhatIsOutOfRangeCountsAsTheNearest) {
  Durations durations(Durations::Keep::Binned);
  for (const double ms : {-1.0, 0.0, 1e9}) durations.add(ms);
  EXPECT_NEAR(durations.summary().p50, 0.01, 1e-4);
  EXPECT_GT(durations.summary().p99, 70000);
}

TEST(Durations, NoneAreZero) {
  for (const auto keep : {Durations::Keep::All, Durations::Keep::Binned}) EXPECT_EQ(Durations(keep).summary().p99, 0);
}

}  // namespace
}  // namespace depthmocap

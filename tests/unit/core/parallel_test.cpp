#include "libtracker/core/parallel.h"

#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr std::size_t kCount = 1000;

std::vector<std::size_t> squares(int threads) {
  std::vector<std::size_t> values(kCount, 0);
  parallelFor(threads, kCount, [&](std::size_t i) { values[i] += i * i; });
  return values;
}

TEST(ParallelFor, AnyNumberOfThreadsCallsEachIndexOnce) {
  const std::vector<std::size_t> plain = squares(1);
  EXPECT_EQ(plain[30], 900U);
  for (const int threads : {2, 3, 16, 2}) EXPECT_EQ(squares(threads), plain) << threads;
}

TEST(ParallelFor, NeverRunsOnMoreThreadsThanAsked) {
  std::atomic<int> now = 0;
  std::atomic<int> most = 0;
  parallelFor(2, 200, [&](std::size_t) {
    const int mine = ++now;
    int seen = most;
    while (mine > seen && !most.compare_exchange_weak(seen, mine)) {
    }
    std::this_thread::yield();
    --now;
  });
  EXPECT_GE(most, 1);
  EXPECT_LE(most, 2);
}

TEST(ParallelFor, RethrowsTheFailureOfTheLowestIndexAfterAllWereCalled) {
  std::atomic<std::size_t> calls = 0;
  const auto failing = [&](std::size_t i) {
    ++calls;
    if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
  };
  try {
    parallelFor(4, 100, failing);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "7");
  }
  EXPECT_EQ(calls, 100U);
  EXPECT_EQ(squares(4), squares(1));  // it can be used again
}

TEST(ParallelFor, ALoopInABodyRunsOnTheThreadOfTheBody) {
  std::vector<std::size_t> sums(40, 0);
  std::atomic<bool> strayed = false;
  parallelFor(2, sums.size(), [&](std::size_t i) {
    const std::thread::id mine = std::this_thread::get_id();
    parallelFor(3, 50, [&](std::size_t k) {
      if (std::this_thread::get_id() != mine) strayed = true;
      sums[i] += k;
    });
  });
  EXPECT_FALSE(strayed);
  for (const std::size_t sum : sums) EXPECT_EQ(sum, 1225U);
}

TEST(ParallelFor, SeveralCallersShareTheProcessors) {
  const std::vector<std::size_t> plain = squares(1);
  std::atomic<int> wrong = 0;
  std::vector<std::thread> callers;
  for (int caller = 0; caller < 4; ++caller) {
    callers.emplace_back([&, caller] {
      for (int round = 0; round < 20; ++round) wrong += squares(1 + caller) == plain ? 0 : 1;
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace depthmocap

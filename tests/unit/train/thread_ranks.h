#pragma once
#include <barrier>
#include <functional>
#include <numeric>
#include <thread>
#include <vector>

#include "forest/train/communicator.h"

namespace depthmocap::test {

// Ranks that are threads of this process.
class ThreadRanks {
 public:
  explicit ThreadRanks(int size) : size_(size), barrier_(size), slots_(static_cast<std::size_t>(size)) {}

  // Calls body(communicator) on every rank and waits for all.
  void run(const std::function<void(Communicator&)>& body) {
    std::vector<std::jthread> threads;
    for (int r = 0; r < size_; ++r) {
      threads.emplace_back([this, r, &body] {
        Rank rank(*this, r);
        body(rank);
      });
    }
  }

 private:
  struct Slot {
    std::span<std::uint32_t> small;
    std::span<std::int64_t> large;
    const std::vector<Communicator::Bytes>* outgoing = nullptr;
  };

  class Rank : public Communicator {
   public:
    Rank(ThreadRanks& all, int rank) : all_(all), rank_(rank) {}
    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int size() const override { return all_.size_; }
    void sum(std::span<std::uint32_t> numbers) override { addUp(numbers, &Slot::small, all_.size_); }
    void sum(std::span<std::int64_t> numbers) override { addUp(numbers, &Slot::large, all_.size_); }
    void sumBefore(std::span<std::uint32_t> numbers) override { addUp(numbers, &Slot::small, rank_); }
    std::vector<Bytes> exchange(const std::vector<Bytes>& outgoing) override {
      own().outgoing = &outgoing;
      all_.barrier_.arrive_and_wait();
      std::vector<Bytes> incoming;
      for (const Slot& slot : all_.slots_) incoming.push_back((*slot.outgoing)[static_cast<std::size_t>(rank_)]);
      all_.barrier_.arrive_and_wait();
      return incoming;
    }

   private:
    Slot& own() { return all_.slots_[static_cast<std::size_t>(rank_)]; }
    template <typename Number>
    void addUp(std::span<Number> numbers, std::span<Number> Slot::*place, int end) {
      own().*place = numbers;
      all_.barrier_.arrive_and_wait();
      std::vector<Number> sums(numbers.size(), 0);
      for (int r = 0; r < end; ++r) {
        const auto& from = all_.slots_[static_cast<std::size_t>(r)].*place;
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += from[i];
      }
      all_.barrier_.arrive_and_wait();
      std::copy(sums.begin(), sums.end(), numbers.begin());
    }

    ThreadRanks& all_;
    int rank_;
  };

  int size_;
  std::barrier<> barrier_;
  std::vector<Slot> slots_;
};

}  // namespace depthmocap::test

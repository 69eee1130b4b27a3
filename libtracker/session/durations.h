#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace depthmocap {

// Times of one kind [ms], for their percentiles.
class Durations {
 public:
  // All: exact, and the memory grows by 8 bytes per value: for work that ends. Binned: percentiles within 0.5 %, and
  // the memory stays what it is: for runs that may take days.
  enum class Keep { All, Binned };
  explicit Durations(Keep keep) : keep_(keep) {}

  void add(double ms);

  // Nearest-rank percentiles; all zero without a value.
  struct Summary {
    double p50 = 0;
    double p95 = 0;
    double p99 = 0;
    double mean = 0;
    double max = 0;
  };
  [[nodiscard]] Summary summary() const;

 private:
  [[nodiscard]] double binned(double share) const;

  static constexpr int kBins = 1600;  // from 0.01 ms to 80 s, each 1 % wider than the one before
  Keep keep_;
  std::uint64_t count_ = 0;
  double sum_ = 0;
  double max_ = 0;
  std::vector<double> all_;
  std::array<std::uint32_t, kBins> bins_{};
};

}  // namespace depthmocap

#include "libtracker/session/durations.h"

#include <algorithm>
#include <cmath>

namespace depthmocap {
namespace {

constexpr double kFirst_ms = 0.01;
constexpr double kRatio = 1.01;

std::uint64_t rankOf(double share, std::uint64_t count) {
  return static_cast<std::uint64_t>(std::llround(share * static_cast<double>(count - 1)));
}

}  // namespace

void Durations::add(double ms) {
  ++count_;
  sum_ += ms;
  max_ = std::max(max_, ms);
  if (keep_ == Keep::All) {
    all_.push_back(ms);
    return;
  }
  const double bin = std::log(std::max(ms, kFirst_ms) / kFirst_ms) / std::log(kRatio);
  ++bins_[static_cast<std::size_t>(std::min<double>(bin, kBins - 1))];
}

// The middle of the bin that holds the value of this rank.
double Durations::binned(double share) const {
  const std::uint64_t rank = rankOf(share, count_);
  std::uint64_t below = 0;
  std::size_t bin = 0;
  while (below + bins_[bin] <= rank) below += bins_[bin++];
  return kFirst_ms * std::pow(kRatio, static_cast<double>(bin) + 0.5);
}

Durations::Summary Durations::summary() const {
  if (count_ == 0) return {};
  const double mean = sum_ / static_cast<double>(count_);
  if (keep_ == Keep::Binned) return {binned(0.50), binned(0.95), binned(0.99), mean, max_};
  std::vector<double> sorted = all_;
  std::sort(sorted.begin(), sorted.end());
  const auto ranked = [&](double share) { return sorted[rankOf(share, count_)]; };
  return {ranked(0.50), ranked(0.95), ranked(0.99), mean, max_};
}

}  // namespace depthmocap

#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace depthmocap {

// Finds rows by their frame number; numbers grow from row to row, as the file readers guarantee.
template <typename Row>
class FrameMatcher {
 public:
  explicit FrameMatcher(const std::vector<Row>& rows) : rows_(rows) {}
  // nullptr if there is no such frame.
  [[nodiscard]] const Row* find(std::int64_t frame) const {
    const auto before = [](const Row& row, std::int64_t wanted) { return row.frame < wanted; };
    const auto found = std::lower_bound(rows_.begin(), rows_.end(), frame, before);
    return found != rows_.end() && found->frame == frame ? &*found : nullptr;
  }

 private:
  const std::vector<Row>& rows_;
};

}  // namespace depthmocap

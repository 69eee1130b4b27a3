#include "apps/view/connection_pool.h"

#include <algorithm>
#include <utility>

namespace depthmocap {

ConnectionPool::Place ConnectionPool::enter(Entry entry) {
  const auto is_neighbour = [&](const Entry& other) { return other.address == entry.address; };
  const auto neighbours = static_cast<std::size_t>(std::ranges::count_if(entries_, is_neighbour));
  // close() only asks for the end; the place is given back by the one who holds it. So that a closed one is not asked
  // twice, it goes to the end of the queue.
  if (neighbours >= std::max<std::size_t>(1, most_ / 2)) {
    const auto slowest = std::ranges::find_if(entries_, is_neighbour);
    slowest->close();
    progressed(slowest);
  } else if (entries_.size() >= most_) {
    closeSlowest();
  }
  entries_.push_back(std::move(entry));
  return std::prev(entries_.end());
}

bool ConnectionPool::closeSlowest() {
  if (entries_.empty()) return false;
  entries_.front().close();
  progressed(entries_.begin());
  return true;
}

}  // namespace depthmocap

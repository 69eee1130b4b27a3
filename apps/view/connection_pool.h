#pragma once
#include <cstddef>
#include <functional>
#include <list>
#include <string>

namespace depthmocap {

// The places of connections that have a request on its way, of which there are few. Whoever is slow loses: a newcomer
// takes the place of the one that has made no progress for longest, first among those of its own address, so that
// nobody can shut others out by holding places, whether they know the token or not. Used on one thread.
class ConnectionPool {
 public:
  struct Entry {
    std::string address;
    std::function<void()> close;  // ends the connection
  };
  using Place = std::list<Entry>::iterator;

  // At most so many (>= 2), and of one address half of them.
  explicit ConnectionPool(int most) : most_(static_cast<std::size_t>(most)) {}

  Place enter(Entry entry);
  // It is no longer the next to go.
  void progressed(Place place) { entries_.splice(entries_.end(), entries_, place); }
  void leave(Place place) { entries_.erase(place); }
  // The one without progress for longest is closed; false where there is none.
  bool closeSlowest();

 private:
  std::size_t most_;
  std::list<Entry> entries_;  // the one without progress for longest first
};

}  // namespace depthmocap

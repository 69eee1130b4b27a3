#pragma once
#include <cstddef>
#include <type_traits>

namespace depthmocap {

namespace detail {
void parallelForImpl(int threads, std::size_t count, void (*call)(void*, std::size_t), void* context);
}

// Calls body(i) once for each i in [0, count) on at most `threads` threads (>= 1), one of them the caller's, which
// never waits for a thread that has not begun: with other programs on all processors it is as fast as one thread.
// Results must not depend on which thread runs what, so a body writes only to its own slot; sums are added afterwards
// in index order. Exceptions of a body are rethrown here (the one of the lowest index). A loop in a body runs on the
// body's thread.
template <typename Body>
void parallelFor(int threads, std::size_t count, Body&& body) {
  using Plain = std::remove_reference_t<Body>;
  detail::parallelForImpl(
      threads, count, [](void* context, std::size_t i) { (*static_cast<Plain*>(context))(i); },
      const_cast<void*>(static_cast<const void*>(&body)));
}

}  // namespace depthmocap

#include "libtracker/core/parallel.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <mutex>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace depthmocap::detail {
namespace {

// ThreadSanitizer does not see how the packaged oneTBB orders its threads and is told: what was done before a give is
// seen after a take of the same thing.
void give([[maybe_unused]] void* thing) {
#ifdef __SANITIZE_THREAD__
  __tsan_release(thing);
#endif
}
void take([[maybe_unused]] void* thing) {
#ifdef __SANITIZE_THREAD__
  __tsan_acquire(thing);
#endif
}

// The exception of the lowest index; the others are dropped.
class Failure {
 public:
  void note(std::size_t index) {
    const std::scoped_lock lock(mutex_);
    if (index >= index_) return;
    index_ = index;
    exception_ = std::current_exception();
  }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::mutex mutex_;
  std::size_t index_ = std::numeric_limits<std::size_t>::max();
  std::exception_ptr exception_;
};

// Whether this thread is in the body of a loop: a loop inside another runs on the thread that calls it.
thread_local bool in_body = false;

void runRange(const tbb::blocked_range<std::size_t>& range, void (*call)(void*, std::size_t), void* context,
              Failure& failure) {
  take(&failure);
  in_body = true;
  for (std::size_t i = range.begin(); i != range.end(); ++i) {
    try {
      call(context, i);
    } catch (...) {
      failure.note(i);
    }
  }
  in_body = false;
  give(&failure);
}

// Where the calling thread's loops run. Each caller has an arena of its own: in a shared one it would wait for a place
// that somebody else's loop holds.
tbb::task_arena& arenaOf(int threads) {
  thread_local tbb::task_arena arena;
  threads = std::min(threads, tbb::info::default_concurrency());  // it has no threads beyond the processors
  if (!arena.is_active() || arena.max_concurrency() != threads) {
    arena.terminate();
    arena.initialize(threads);
  }
  return arena;
}

}  // namespace

void parallelForImpl(int threads, std::size_t count, void (*call)(void*, std::size_t), void* context) {
  if (threads <= 1 || count <= 1 || in_body) {
    for (std::size_t i = 0; i < count; ++i) call(context, i);
    return;
  }
  Failure failure;
  give(&failure);
  // The caller works, too, and waits for those tasks only that another thread has begun: where no processor is free for
  // others, it does all of them.
  arenaOf(threads).execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count),
        [&](const tbb::blocked_range<std::size_t>& range) { runRange(range, call, context, failure); },
        tbb::simple_partitioner());
  });
  take(&failure);
  failure.rethrow();
}

}  // namespace depthmocap::detail

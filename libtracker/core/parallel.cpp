#include "libtracker/core/parallel.h"

#include <exception>
#include <limits>

namespace depthmocap::detail {

void parallelForImpl(int threads, std::size_t count, void (*call)(void*, std::size_t), void* context) {
  if (threads <= 1 || count <= 1) {
    for (std::size_t i = 0; i < count; ++i) call(context, i);
    return;
  }
  std::exception_ptr failure;
  std::size_t failed_at = std::numeric_limits<std::size_t>::max();
#pragma omp parallel for num_threads(threads) schedule(dynamic, 1)
  for (std::size_t i = 0; i < count; ++i) {
    try {
      call(context, i);
    } catch (...) {
#pragma omp critical
      if (i < failed_at) {
        failed_at = i;
        failure = std::current_exception();
      }
    }
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace depthmocap::detail

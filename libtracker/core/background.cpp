#include "libtracker/core/background.h"

#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

namespace depthmocap {
namespace {

constexpr int kNice = 10;  // about a tenth of the share of a normal thread

}  // namespace

void runInBackground() {
  // On Linux each thread has a priority of its own: a nice value, or where the program was started so, a real-time one.
  const int policy = sched_getscheduler(0);
  if (policy == SCHED_FIFO || policy == SCHED_RR) {
    const sched_param lowest{.sched_priority = sched_get_priority_min(policy)};
    (void)sched_setparam(0, &lowest);
  } else {
    (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
  }
}

}  // namespace depthmocap

#include "apps/view/background.h"

#include <sys/resource.h>
#include <unistd.h>

namespace depthmocap {
namespace {

constexpr int kNice = 10;  // about a tenth of the share of a normal thread

}  // namespace

void runInBackground() {
  // On Linux each thread has a priority of its own.
  (void)setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
}

}  // namespace depthmocap

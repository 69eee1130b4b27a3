#include "apps/terminal/stop_request.h"

#include <atomic>

#include <signal.h>

namespace depthmocap {

namespace {

std::atomic<bool> stop_requested{false};  // lock-free, as a signal handler needs
static_assert(std::atomic<bool>::is_always_lock_free);

void onSignal(int) {
  stop_requested = true;
}

void handle(int signal_number, void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(signal_number, &action, nullptr);
}

bool isIgnored(int signal_number) {
  struct sigaction action = {};
  sigaction(signal_number, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}

}  // namespace

StopRequest::StopRequest() {
  stop_requested = false;
  handle(SIGINT, onSignal);
  handle(SIGTERM, onSignal);
  if (!isIgnored(SIGHUP)) handle(SIGHUP, onSignal);  // as by nohup
}

StopRequest::~StopRequest() {
  handle(SIGINT, SIG_DFL);
  handle(SIGTERM, SIG_DFL);
  if (!isIgnored(SIGHUP)) handle(SIGHUP, SIG_DFL);
}

bool StopRequest::made() {
  return stop_requested;
}

}  // namespace depthmocap

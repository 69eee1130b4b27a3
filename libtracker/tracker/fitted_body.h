#pragma once
#include "depthmocap/tracker.h"

namespace depthmocap {

// The bodies that are fitted while tracking, for those who track a recording twice. No part of the public Tracker.
struct FittedBody {
  // Somebody's body is still to be fitted.
  static bool isWanted(const Tracker& tracker);
  // From the next run on, everybody whose body was fitted in this one has it from the first frame.
  static void keep(Tracker& tracker);
};

}  // namespace depthmocap

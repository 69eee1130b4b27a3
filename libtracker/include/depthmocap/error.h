#pragma once
#include <stdexcept>
#include <string>

#include "depthmocap/export.h"

namespace depthmocap {

// The one exception type for files, devices and options: what failed, where, and what to do about it.
// Bugs are not Errors (see check.h), and a bad frame is not one either: it is data (TrackState).
// Libraries throw it; only the program prints it, once, as one line, and exits with 1.
class DEPTHMOCAP_API Error : public std::runtime_error {
 public:
  // `what` names the failure with its reason, `where` the file, device or option, `advice` what the user can do.
  Error(const std::string& what, const std::string& where, const std::string& advice = {})
      : std::runtime_error(where + ": " + what + (advice.empty() ? "" : " (" + advice + ")")) {}
};

}  // namespace depthmocap

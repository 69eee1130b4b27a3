#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "depthmocap/error.h"

namespace depthmocap {

// The frames of a run that cannot be read, told in a few lines: those whose errors differ in digits alone, a whole
// series of pictures of another size for example, are one line.
class UnreadableFrames {
 public:
  void add(const Error& error);
  // A line for each reason, in the order of their first frames. `consequence` completes "the frame is ...".
  [[nodiscard]] std::vector<std::string> lines(const std::string& consequence) const;

 private:
  struct Kind {
    std::string reason;
    std::string first;  // what was said of its first frame
    std::size_t count = 0;
  };
  std::vector<Kind> kinds_;
  std::size_t of_other_kinds_ = 0;
};

}  // namespace depthmocap

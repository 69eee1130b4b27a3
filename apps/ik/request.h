#pragma once
#include <string>
#include <vector>

#include "apps/ik/setup.h"

namespace depthmocap {

// Answers POST /ik: JSON in, JSON out, as docs/reference/stream.md describes.
class IkRequests {
 public:
  explicit IkRequests(const IkCommandOptions& options);  // loads what every prior needs

  // Error says what is wrong with the request. Any thread.
  [[nodiscard]] std::string answer(const std::string& body) const;

 private:
  Skeleton skeleton_;
  std::vector<IkSolver> lm_;       // by prior
  std::vector<IkSolver> classic_;  // by method, from Jacobian on
};

}  // namespace depthmocap

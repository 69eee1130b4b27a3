#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "apps/ik/setup.h"

namespace depthmocap {

// Answers POST /ik: JSON in, JSON out, as docs/reference/stream.md describes.
class IkRequests {
 public:
  explicit IkRequests(const IkCommandOptions& options);  // loads what every prior needs

  // Error says what is wrong with the request. Any thread, several at once.
  [[nodiscard]] std::string answer(const std::string& body) const;

  // The keys that a request may have.
  static constexpr std::array<std::string_view, 8> kKeys = {"targets", "prior", "prior_weight_m", "solver",
                                                            "weights", "start", "hold",           "bones"};

 private:
  Skeleton skeleton_;
  std::vector<IkSolver> lm_;      // by prior
  std::vector<IkSolver> others_;  // by method, from Jacobian on
};

}  // namespace depthmocap

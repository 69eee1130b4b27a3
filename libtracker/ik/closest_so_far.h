#pragma once
#include "depthmocap/ik_result.h"

namespace depthmocap {

// Keeps the closest pose of a solver whose steps may lead away for a while, and says when to stop.
class ClosestSoFar {
 public:
  ClosestSoFar(const Pose& start, double residual_m) : best_{start, residual_m, 0} {}

  [[nodiscard]] bool goesOn(int max_iterations) const {
    return best_.iterations < max_iterations && waited_ < kPatience;
  }
  void add(const Pose& q, double residual_m) {
    ++best_.iterations;
    waited_ = residual_m < best_.residual_m - kLeastGain_m ? 0 : waited_ + 1;
    if (residual_m >= best_.residual_m) return;
    best_.q = q;
    best_.residual_m = residual_m;
  }
  [[nodiscard]] const IkResult& result() const { return best_; }

 private:
  static constexpr double kLeastGain_m = 1e-6;  // in kPatience steps
  static constexpr int kPatience = 5;

  IkResult best_;
  int waited_ = 0;
};

}  // namespace depthmocap

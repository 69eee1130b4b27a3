#pragma once
#include <cstddef>
#include <deque>
#include <optional>

#include "depthmocap/pose.h"
#include "libtracker/skeleton/normal_equations.h"

namespace depthmocap {

// The poses of a recording that explain all of its frames together: maximum a posteriori over time. Each frame leaves
// what it says of its pose by itself, equation (5) without its smoothness, as a quadratic about the pose that was
// tracked; over time the velocity is expected to stay (E_smooth of equation (5), looking both ways). The minimum of the
// sum is a block-banded linear system (Rauch, Tung, Striebel 1965 solve the same one by recursion). So what a frame
// hardly sees comes from the frames before and after it, and what it sees well hardly moves.
//
// A long track is solved piece by piece, each with `reach_s` of context on either side: memory and delay are bounded.
class ClipSmoother {
 public:
  struct Sample {
    double time_s = 0;  // [s] strictly increasing
    Pose q = Pose::Zero();
    bool joined = false;       // goes on from the sample before: the same track in the same world
    NormalEquations evidence;  // about q, without smoothness
  };
  // reach_s [s] (>= 0): frames so far away still count; 0 leaves poses as they are, at once.
  explicit ClipSmoother(double reach_s);
  void add(const Sample& sample);
  // No sample will follow.
  void finish() { finished_ = true; }
  // The pose of the oldest sample not given yet; nothing as long as samples that it depends on are to come.
  std::optional<Pose> next();

 private:
  [[nodiscard]] std::size_t contextOf(std::size_t i) const;
  void solvePiece();
  void solve(std::size_t end);

  double reach_s_;
  bool finished_ = false;
  std::deque<Sample> samples_;  // those that poses to be given depend on
  std::deque<Pose> solved_;     // of samples_ from given_ on
  std::size_t given_ = 0;       // samples given, of those held
};

}  // namespace depthmocap

#pragma once
#include <cstddef>
#include <deque>
#include <optional>

#include "depthmocap/pose.h"

namespace depthmocap {

// Calms a track with what comes before and after each pose: the value of a local quadratic fit (Cleveland 1979,
// Savitzky and Golay 1964 where frames come regularly) with weights that fall to 0 at `half_width_s`. Without delay in
// time, and steady acceleration is kept; so poses are given later than they were added.
class LookAheadSmoother {
 public:
  struct Sample {
    double time_s = 0;  // [s] strictly increasing
    Pose q = Pose::Zero();
    bool joined = false;  // goes on from the sample before: the same track in the same world
  };
  // `half_width_s` [s] (>= 0); 0 leaves poses as they are, at once.
  explicit LookAheadSmoother(double half_width_s);
  void add(const Sample& sample);
  // No sample will follow.
  void finish() { finished_ = true; }
  // The pose of the oldest sample not given yet; nothing as long as samples that it depends on are to come.
  std::optional<Pose> next();

 private:
  [[nodiscard]] bool reaches(std::size_t a, std::size_t b) const;
  [[nodiscard]] bool complete() const;
  [[nodiscard]] Pose smoothed() const;

  double half_width_s_;
  bool finished_ = false;
  std::deque<Sample> samples_;  // those that poses to be given depend on
  std::size_t due_ = 0;         // index of the oldest not given yet
};

}  // namespace depthmocap

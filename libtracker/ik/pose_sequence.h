#pragma once
#include <memory>
#include <vector>

#include "libtracker/ik/pose_prior.h"
#include "libtracker/ik/pose_term.h"

namespace depthmocap {

// What was measured at one instant; nullptr where nothing was.
struct SequenceFrame {
  double time_s = 0;
  std::unique_ptr<PoseTerm> measured;  // rows over their standard deviation: without unit
};

struct SequenceConfig {
  // [s] (> 0) the prior counts once in this time, however many frames that are: natural poses follow natural ones.
  double prior_interval_s = 0.3;
  // Spectral density of accelerations, white noise: of angles [rad^2/s^3] and of the root's place [m^2/s^3] (> 0).
  double turn_density = 30.0;
  double move_density = 2.0;
  int max_iterations = 40;  // (>= 1) steps tried
  int threads = 2;          // (>= 1) the result does not depend on it
  void validate() const;    // throws Error naming field, value and rule
};

// The poses of a whole sequence at once: the maximum a posteriori
//   argmin sum_t |measured_t(q_t)|^2 + dt / interval |prior(q_t)|^2 + sum_t |q_t+1 - 2 q_t + q_t-1|^2 / (density dt^3)
// (with divided differences where frames are not evenly spaced), within joint limits, by Levenberg-Marquardt; normal
// equations are block-pentadiagonal. Place and heading have no prior. start: one pose a frame, continuous angles; times
// grow. prior may be nullptr. Sequences longer than kSequenceWindow frames are solved in windows that continue each
// other, so that memory is bounded.
std::vector<Pose> solveSequence(std::vector<SequenceFrame>& frames, const PosePrior* prior,
                                const SequenceConfig& config, std::vector<Pose> start);

inline constexpr std::size_t kSequenceWindow = 2048;  // [frames] 60 MB of normal equations

}  // namespace depthmocap

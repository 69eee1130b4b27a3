#pragma once
#include <Eigen/Core>
#include <vector>

#include "depthmocap/pose.h"
#include "libtracker/skeleton/normal_equations.h"

namespace depthmocap {

// A symmetric matrix over the poses of a sequence in which a pose meets the two before it, each degree of freedom only
// itself: A_tt full, A_t,t-1 and A_t,t-2 diagonal.
class BlockBand {
 public:
  explicit BlockBand(std::size_t frames) : diagonal(frames), back1(frames), back2(frames) {}

  std::vector<PoseMatrix> diagonal;  // A_tt, both triangles
  std::vector<Pose> back1;           // the diagonal of A_t,t-1; that of frame 0 is not read
  std::vector<Pose> back2;           // the diagonal of A_t,t-2; those of frames 0 and 1 are not read

  // x with A x = b by Cholesky decomposition; A must be positive definite, else x has numbers that are not finite.
  [[nodiscard]] std::vector<Pose> solve(const std::vector<Pose>& b) const;
  // A x.
  [[nodiscard]] std::vector<Pose> times(const std::vector<Pose>& x) const;
};

}  // namespace depthmocap

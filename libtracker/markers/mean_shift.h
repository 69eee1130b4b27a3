#pragma once
#include <Eigen/Core>
#include <vector>

#include "libtracker/markers/voxel_votes.h"

namespace depthmocap {

// MeanShift (Comaniciu & Meer 2002) over weighted points with the kernel of Shotton 2011, exp(-(distance /
// bandwidth)^2), evaluated as (1 - x / 32)^32: within 0.01 of it, exactly 0 from 5.7 bandwidths on, and the same on
// every machine.
class MeanShift {
 public:
  // Sum of weight * kernel at a point; `mean`, if not null, receives the kernel-weighted mean of the points (unchanged
  // when the density is 0).
  float density(const PartVotes& votes, const Eigen::Vector3f& at, float bandwidth_m, Eigen::Vector3f* mean = nullptr);

  // Climbs from `point` to the mode above it; returns the density there. Stops after max_iterations or when a step is
  // shorter than 0.5 mm.
  float climb(const PartVotes& votes, float bandwidth_m, int max_iterations, Eigen::Vector3f& point);

 private:
  std::vector<float> kernel_;
};

}  // namespace depthmocap

#pragma once
#include <cstdint>

#include "libtracker/posedb/pose_database.h"
#include "libtracker/posedb_build/pose_mixture.h"

namespace depthmocap {

struct PoseMixtureConfig {
  int components = 300;    // (>= 1) clusters to start from
  int min_poses = 40;      // (> PoseMixture::kDims) a smaller cluster is dissolved into its neighbours
  int iterations = 25;     // (>= 1) of k-means
  std::uint64_t seed = 1;  // of the first centres
  int threads = 2;         // (>= 1)
  void validate() const;
};

// Throws Error if the database is smaller than one component.
PoseMixture fitPoseMixture(const PoseDatabase& database, const PoseMixtureConfig& config);

}  // namespace depthmocap

#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "libtracker/posedb_build/build_pose_database.h"
#include "libtracker/posedb_build/pose_mixture.h"

namespace depthmocap {

// What a pose database is made of; its line of origin says so.
struct PoseDatabaseSources {
  std::vector<MotionClip> clips;      // captured ones first, then procedural ones
  std::size_t captured = 0;           // of the clips
  bool procedural = false;            // whether procedural motions were asked for
  std::vector<std::string> excluded;  // names of motions that were left out
  PoseMixture mixture;                // poses are drawn from it; without components none are
  std::size_t sample_count = 30000;   // poses to draw
  std::uint64_t seed = 1;             // of the procedural motions and the samples
};

// Builds a database from the clips (buildPoseDatabase) and adds poses drawn from the mixture as one more source. They
// are not thinned out: two draws are hardly ever alike.
PoseDatabaseResult composePoseDatabase(const PoseDatabaseSources& sources, const PoseDatabaseConfig& config);

}  // namespace depthmocap

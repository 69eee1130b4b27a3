#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/ik/gaussian_prior.h"
#include "libtracker/ik/network_priors.h"

namespace depthmocap {

// What was learned of natural poses: statistics and networks, no pose itself.
struct LearnedPoses {
  PoseGaussian ppca;
  std::vector<PoseGaussian> mixture;
  PoseScale scale;  // of both coders
  PoseCoder autoencoder;
  PoseCoder variational;
  std::string origin;  // one line: data and command
};

// Numbers are stored as 16-bit floats. Both throw Error (missing, not such a file, truncated, damaged).
LearnedPoses loadLearnedPoses(const std::filesystem::path& path);
void saveLearnedPoses(const LearnedPoses& poses, const std::filesystem::path& path);

}  // namespace depthmocap

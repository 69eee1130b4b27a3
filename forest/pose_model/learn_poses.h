#pragma once
#include <cstdint>
#include <functional>

#include "libtracker/ik/learned_poses.h"
#include "libtracker/posedb/pose_database.h"

namespace depthmocap {

// How the pose priors of inverse kinematics are learned.
struct PoseLearningConfig {
  int components = 70;      // (>= 1) of the mixture, as in GMM-IK; small ones are dissolved
  int width = 128;          // [neurons] (>= 1) of hidden layers
  int code = 20;            // (1 .. 31) of the autoencoder
  int latent = 24;          // (1 .. 31) of the variational autoencoder
  double noise = 1.0;       // [deviations] (>= 0) added to the autoencoder's inputs; 0: the paper's plain autoencoder
  double kl_weight = 0.03;  // (> 0) of the Kullback-Leibler divergence against the squared error of a DoF
  int epochs = 60;          // (>= 1) passes over all poses
  int batch = 256;          // [poses] (>= 1)
  double learning_rate = 1e-3;  // (> 0) falls to 0 along half a cosine
  std::uint64_t seed = 1;       // of first weights, order and noise
  int threads = 2;              // (>= 1) of the mixture; networks learn on one
  void validate() const;        // throws Error naming field, value and rule
};

// How well poses are described: squares averaged over poses and DoFs.
struct PoseLearningError {
  double ppca = 0;         // [deviations] root mean square of what the principal components leave
  double autoencoder = 0;  // [deviations] of what is lost on the way through the code
  double variational = 0;  // [deviations] the same through the mean of the latent code
};

// PPCA, mixture, autoencoder (denoising: Vincent et al. 2008) and variational autoencoder (Kingma and Welling 2014) of
// the database's poses. `progress` is told how much is done of a total. Same result for any number of threads.
LearnedPoses learnPoses(const PoseDatabase& database, const PoseLearningConfig& config,
                        const std::function<void(std::size_t done, std::size_t total)>& progress);

PoseLearningError learningError(const LearnedPoses& learned, const PoseDatabase& database);

}  // namespace depthmocap

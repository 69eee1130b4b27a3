#pragma once
#include <memory>
#include <vector>

#include "libtracker/posedb/pose_database.h"
#include "libtracker/posedb/pose_search.h"
#include "libtracker/prior/prior_config.h"

namespace depthmocap {

// Builds the local model (4) of one frame: PCA over the K nearest poses, unweighted. For the paper's subspace K and B
// are chosen by leave-one-out cross-validation; a Gaussian (PriorConfig::residual_rad) takes all neighbours and
// directions, because what hardly varies among the neighbours costs it as much as what lies outside of their span.
//
// The criterion. The error of rebuilding a left-out pose by projecting it would fall with every further dimension, so
// it cannot choose B. Instead each left-out pose must be *predicted*: for every bone in turn, the bone's DoFs are
// hidden, phi is fitted to all other DoFs by least squares, and the hidden DoFs are read off mean + P_B phi.
// (Row-and-element-wise cross-validation of component models: Bro, Kjeldahl, Smilde, Kiers 2008; Owen and Perry 2009.)
// It is also what the tracker asks of the prior: to fill in what the camera does not see. Every model (K, B) is judged
// on the same poses, the `held_out` nearest of all, each left out of its own model; the smallest summed squared error
// [rad^2] wins, ties by the smaller K, then the smaller B.
//
// Thread-compatible; build() does not allocate after construction.
class LocalPriorBuilder {
 public:
  explicit LocalPriorBuilder(const PriorConfig& config);
  ~LocalPriorBuilder();
  LocalPriorBuilder(LocalPriorBuilder&&) noexcept;

  // `neighbours`: nearest first, as from PoseSearch::search. With fewer than the smallest K all are used; a set without
  // variance gives fewer dimensions, down to 0. At least one neighbour.
  void build(const PoseDatabase& database, const std::vector<PoseNeighbour>& neighbours, LocalPrior& prior);

  // Cross-validation error [rad^2] of the i-th K and the j-th B of the configuration in the last build(); infinite for
  // a model that the neighbours could not support.
  [[nodiscard]] double modelError(std::size_t i, std::size_t j) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap

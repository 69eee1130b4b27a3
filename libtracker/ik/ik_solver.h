#pragma once
#include <memory>
#include <optional>

#include "depthmocap/ik.h"
#include "libtracker/ik/learned_poses.h"
#include "libtracker/ik/levenberg_marquardt.h"
#include "libtracker/ik/target_term.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

struct IkConfig {
  IkMethod method = IkMethod::Lm;
  IkPrior prior = IkPrior::None;  // with Lm only
  // [m] (>= 0) how far a joint may stay from its target for one unit of the prior. For exact targets; half of what each
  // coordinate is off by suits others.
  double weight_m = 0.001;
  int starts = 4;  // (>= 1) typical poses, those nearest to the targets, that a solve with a prior starts from
  // Steps that every start may try before those that lead race on alone, and how many do (>= 1). [steps], [starts]
  int race_iterations = 2;
  int race_winners = 2;
  LmConfig lm = {};
  // Whether a solver needs learned poses.
  [[nodiscard]] bool needsLearned() const { return prior != IkPrior::None || method == IkMethod::Latent; }
  void validate() const;  // throws Error naming field, value and rule
};

// What one solve by IkMethod::Lm may have of its own.
struct IkRun {
  std::optional<Pose> start = {};       // the only one: finds what lies near it, in less time
  std::optional<double> weight_m = {};  // [m] (>= 0) in place of IkConfig::weight_m
};

// A pose and how well it does.
struct IkSolution {
  IkResult result;    // residual_m is 0
  double energy = 0;  // [m^2] 1/2 |E|^2 of (3.1)
};

// Finds the pose of a body whose joints lie at the targets: (3.1) of MNN-IK. Joint limits hold; where targets are out
// of reach it is the nearest pose that is found. Without a prior a solve starts from the zero pose, as in the paper,
// turned and moved to the targets; with one, from the means of the mixture that lie nearest to the targets. Constant
// after construction: threads may share one. Deterministic.
class IkSolver {
 public:
  // `learned` may be nullptr where config.needsLearned() is false. Throws as IkConfig::validate.
  IkSolver(const Skeleton& skeleton, const IkConfig& config, std::shared_ptr<const LearnedPoses> learned);
  ~IkSolver();
  IkSolver(IkSolver&&) noexcept;

  [[nodiscard]] const Skeleton& skeleton() const;
  [[nodiscard]] IkPrior prior() const;
  [[nodiscard]] double weight_m() const;
  // nullptr for IkPrior::None.
  [[nodiscard]] const PosePrior* posePrior() const;
  // The means of the mixture; the zero shape alone where nothing was learned.
  [[nodiscard]] std::vector<PoseShape> typicalShapes() const;
  // At least one target.
  [[nodiscard]] IkResult solve(const JointTargets& targets) const;
  // The same by IkMethod::Lm.
  [[nodiscard]] IkResult solve(const JointTargets& targets, const IkRun& run) const;
  // Any points of the body, by IkMethod::Lm.
  [[nodiscard]] IkResult solve(const PointTargets& targets) const;
  // The best of the poses that IkMethod::Lm leads to from each start (at least one), for any measurement whose rows are
  // metres.
  [[nodiscard]] IkSolution solveFrom(const std::vector<Pose>& starts, PoseTerm& measured) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace depthmocap

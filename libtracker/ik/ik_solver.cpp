#include "libtracker/ik/ik_solver.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/ik/classic_solvers.h"
#include "libtracker/ik/pose_problem.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

// Of the length of the variational code against what is lost on the way through it.
constexpr double kCodeWeight = 0.2;
// [m] for one unit of the prior: with more of it targets say nothing.
constexpr double kLargestWeight_m = 10;

std::unique_ptr<const PosePrior> priorOf(IkPrior prior, const LearnedPoses& learned) {
  switch (prior) {
    case IkPrior::Ppca:
      return std::make_unique<GaussianPrior>(std::vector{learned.ppca});
    case IkPrior::Gmm:
      return std::make_unique<GaussianPrior>(learned.mixture);
    case IkPrior::Autoencoder:
      return std::make_unique<AutoencoderPrior>(learned.scale, learned.autoencoder);
    case IkPrior::Vae:
      return std::make_unique<VariationalPrior>(learned.scale, learned.variational, kCodeWeight);
    case IkPrior::None:
      break;
  }
  return nullptr;
}

struct Candidate {
  Pose q;
  double energy = 0;
};

}  // namespace

void IkConfig::validate() const {
  if (method != IkMethod::Lm && prior != IkPrior::None) throw Error("prior needs the method lm", "IkConfig");
  checkConfig(weight_m >= 0 && weight_m <= kLargestWeight_m, "IkConfig", "weight_m", weight_m, "from 0 to 10");
  checkConfig(starts >= 1, "IkConfig", "starts", starts, "at least 1");
  checkConfig(lm.max_iterations >= 1, "IkConfig", "lm.max_iterations", lm.max_iterations, "at least 1");
}

struct IkSolver::Impl {
  Impl(const Skeleton& s, const IkConfig& c, std::shared_ptr<const LearnedPoses> l)
      : skeleton(s), config(c), learned(std::move(l)) {
    config.validate();
    DMC_CHECK(config.prior == IkPrior::None || learned != nullptr);
    if (learned != nullptr) prior = priorOf(config.prior, *learned);
  }

  [[nodiscard]] std::vector<Pose> starts(const PointTargets& targets) const;
  [[nodiscard]] IkSolution best(const std::vector<Pose>& starts, PoseTerm& measured) const;

  Skeleton skeleton;
  IkConfig config;
  std::shared_ptr<const LearnedPoses> learned;
  std::unique_ptr<const PosePrior> prior;
};

std::vector<Pose> IkSolver::Impl::starts(const PointTargets& targets) const {
  if (config.prior == IkPrior::None) return {placedAtTargets(skeleton, targets, Pose::Zero())};
  TargetTerm term(skeleton, targets);
  std::vector<Candidate> candidates;
  for (const PoseGaussian& typical : learned->mixture) {
    const Pose q = clampedToLimits(placedAtTargets(skeleton, targets, withShape(Pose::Zero(), typical.mean)));
    candidates.push_back({q, term.rms(q)});
  }
  const std::size_t count = std::min(candidates.size(), static_cast<std::size_t>(config.starts));
  std::partial_sort(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(count), candidates.end(),
                    [](const Candidate& a, const Candidate& b) { return a.energy < b.energy; });
  std::vector<Pose> nearest;
  for (std::size_t i = 0; i < count; ++i) nearest.push_back(candidates[i].q);
  return nearest;
}

IkSolution IkSolver::Impl::best(const std::vector<Pose>& starts, PoseTerm& measured) const {
  IkSolution best;
  int iterations = 0;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    PoseProblem problem(measured, prior.get(), config.weight_m);
    Eigen::VectorXd x = starts[i];
    const LmSummary summary = levenbergMarquardt(problem, config.lm, x);
    iterations += summary.iterations;
    if (i > 0 && !(summary.energy < best.energy)) continue;
    best.result.q = x;
    best.energy = summary.energy;
  }
  best.result.iterations = iterations;
  best.result.q[kRootRy] = std::remainder(best.result.q[kRootRy], 2.0 * std::numbers::pi);
  return best;
}

IkSolver::IkSolver(const Skeleton& skeleton, const IkConfig& config, std::shared_ptr<const LearnedPoses> learned)
    : impl_(std::make_unique<const Impl>(skeleton, config, std::move(learned))) {}
IkSolver::~IkSolver() = default;
IkSolver::IkSolver(IkSolver&&) noexcept = default;

const Skeleton& IkSolver::skeleton() const {
  return impl_->skeleton;
}

IkPrior IkSolver::prior() const {
  return impl_->config.prior;
}

double IkSolver::weight_m() const {
  return impl_->config.weight_m;
}

const PosePrior* IkSolver::posePrior() const {
  return impl_->prior.get();
}

std::vector<PoseShape> IkSolver::typicalShapes() const {
  if (impl_->learned == nullptr) return {PoseShape::Zero()};
  std::vector<PoseShape> shapes;
  for (const PoseGaussian& typical : impl_->learned->mixture) shapes.push_back(typical.mean);
  return shapes;
}

IkSolution IkSolver::solveFrom(const std::vector<Pose>& starts, PoseTerm& measured) const {
  return impl_->best(starts, measured);
}

IkResult IkSolver::solve(const JointTargets& targets, const Pose& start) const {
  TargetTerm term(impl_->skeleton, targets);
  IkResult result = impl_->best({start}, term).result;
  result.residual_m = term.rms(result.q);
  return result;
}

IkResult IkSolver::solve(const PointTargets& targets) const {
  TargetTerm term(impl_->skeleton, targets);
  IkResult result = impl_->best(impl_->starts(targets), term).result;
  result.residual_m = term.rms(result.q);
  return result;
}

IkResult IkSolver::solve(const JointTargets& targets) const {
  const PointTargets points = pointTargets(impl_->skeleton, targets);
  if (impl_->config.method == IkMethod::Lm) return solve(points);
  const Pose start = placedAtTargets(impl_->skeleton, points, Pose::Zero());
  IkResult result;
  if (impl_->config.method == IkMethod::Jacobian) {
    result = solveDampedLeastSquares(impl_->skeleton, targets, start);
  } else if (impl_->config.method == IkMethod::Ccd) {
    result = solveCyclicDescent(impl_->skeleton, targets, start);
  } else {
    result = solveFabrik(impl_->skeleton, targets, start);
  }
  result.q[kRootRy] = std::remainder(result.q[kRootRy], 2.0 * std::numbers::pi);
  return result;
}

}  // namespace depthmocap

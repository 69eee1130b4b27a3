#include "libtracker/ik/ik_solver.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/ik/classic_solvers.h"
#include "libtracker/ik/latent_solver.h"
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
  checkConfig(race_iterations >= 0, "IkConfig", "race_iterations", race_iterations, "at least 0");
  checkConfig(race_winners >= 1, "IkConfig", "race_winners", race_winners, "at least 1");
  checkConfig(lm.max_iterations >= 1, "IkConfig", "lm.max_iterations", lm.max_iterations, "at least 1");
}

struct IkSolver::Impl {
  Impl(const Skeleton& s, const IkConfig& c, std::shared_ptr<const LearnedPoses> l)
      : skeleton(s), config(c), learned(std::move(l)) {
    config.validate();
    DMC_CHECK(!config.needsLearned() || learned != nullptr);
    if (learned != nullptr) prior = priorOf(config.prior, *learned);
    if (config.method == IkMethod::Latent) latent.emplace(learned->scale, learned->variational);
  }

  [[nodiscard]] std::vector<Pose> starts(const PointTargets& targets) const;
  // Of what the starts lead to; only so many go on after the race.
  [[nodiscard]] IkSolution best(const std::vector<Pose>& starts, PoseTerm& measured, double weight_m,
                                int winners) const;

  Skeleton skeleton;
  IkConfig config;
  std::shared_ptr<const LearnedPoses> learned;
  std::unique_ptr<const PosePrior> prior;
  std::optional<LatentSolver> latent;
};

std::vector<Pose> IkSolver::Impl::starts(const PointTargets& targets) const {
  if (!config.needsLearned()) return {placedAtTargets(skeleton, targets, Pose::Zero())};
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

IkSolution IkSolver::Impl::best(const std::vector<Pose>& starts, PoseTerm& measured, double weight_m,
                                int winners) const {
  PoseProblem problem(measured, prior.get(), weight_m);
  std::vector<LevenbergMarquardt> solves;
  solves.reserve(starts.size());
  for (const Pose& start : starts) solves.emplace_back(problem, start);
  const auto energyOf = [](const LevenbergMarquardt& solve) { return solve.summary().energy; };
  IkSolution best;
  if (std::ssize(solves) > winners) {
    for (LevenbergMarquardt& solve : solves) solve.run(std::min(config.race_iterations, config.lm.max_iterations));
    std::ranges::stable_sort(solves, {}, energyOf);
    for (; std::ssize(solves) > winners; solves.pop_back())
      best.result.iterations += solves.back().summary().iterations;
  }
  for (LevenbergMarquardt& solve : solves) {
    solve.run(config.lm.max_iterations);
    best.result.iterations += solve.summary().iterations;
  }
  const LevenbergMarquardt& lowest = *std::ranges::min_element(solves, {}, energyOf);
  best.result.q = lowest.x();
  best.energy = lowest.summary().energy;
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
  return impl_->best(starts, measured, impl_->config.weight_m, static_cast<int>(starts.size()));
}

IkResult IkSolver::solve(const JointTargets& targets, const IkRun& run) const {
  const PointTargets points = pointTargets(impl_->skeleton, targets);
  TargetTerm term(impl_->skeleton, points);
  const std::vector<Pose> starts = run.start ? std::vector<Pose>{*run.start} : impl_->starts(points);
  IkResult result =
      impl_->best(starts, term, run.weight_m.value_or(impl_->config.weight_m), impl_->config.race_winners).result;
  result.residual_m = term.rms(result.q);
  return result;
}

IkResult IkSolver::solve(const PointTargets& targets) const {
  TargetTerm term(impl_->skeleton, targets);
  IkResult result =
      impl_->best(impl_->starts(targets), term, impl_->config.weight_m, impl_->config.race_winners).result;
  result.residual_m = term.rms(result.q);
  return result;
}

IkResult IkSolver::solve(const JointTargets& targets) const {
  const PointTargets points = pointTargets(impl_->skeleton, targets);
  if (impl_->config.method == IkMethod::Lm) return solve(points);
  const Pose start = placedAtTargets(impl_->skeleton, points, Pose::Zero());
  IkResult result;
  if (impl_->latent) {
    TargetTerm term(impl_->skeleton, points);
    result = impl_->latent->solve(impl_->starts(points), impl_->config.lm, term);
  } else if (impl_->config.method == IkMethod::Jacobian) {
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

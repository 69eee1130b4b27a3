#include "depthmocap/ik.h"

#include "depthmocap/error.h"
#include "libtracker/core/shipped_files.h"
#include "libtracker/ik/ik_solver.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

IkConfig configOf(const IkOptions& options) {
  IkConfig config;
  config.method = options.method;
  config.prior = options.prior;
  config.weight_m = options.weight_m;
  config.validate();
  return config;
}

std::shared_ptr<const LearnedPoses> learnedPoses(const IkOptions& options) {
  if (options.prior == IkPrior::None) return nullptr;
  return std::make_shared<const LearnedPoses>(
      loadLearnedPoses(options.learned_poses.empty() ? shippedFile("pose_priors.bin") : options.learned_poses));
}

}  // namespace

struct Ik::Impl {
  Impl(const Skeleton& skeleton, const IkOptions& options)
      : solver(skeleton, configOf(options), learnedPoses(options)) {}
  IkSolver solver;
};

Ik::Ik(const IkOptions& options) : impl_(std::make_unique<const Impl>(makeSkeleton(BoneLengths{}), options)) {}
Ik::Ik(const Actor& actor, const IkOptions& options) : impl_(std::make_unique<const Impl>(actor.skeleton, options)) {}
Ik::~Ik() = default;
Ik::Ik(Ik&&) noexcept = default;
Ik& Ik::operator=(Ik&&) noexcept = default;

IkResult Ik::solve(const JointTargets& targets) const {
  if (targets.count() == 0) throw Error("there is no target", "JointTargets", "add at least one");
  return impl_->solver.solve(targets);
}

JointPositions Ik::joints(const Pose& q) const {
  return jointPositions(impl_->solver.skeleton(), q);
}

}  // namespace depthmocap

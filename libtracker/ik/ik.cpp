#include "depthmocap/ik.h"

#include <string>

#include "depthmocap/error.h"
#include "libtracker/core/config_fields.h"
#include "libtracker/core/shipped_files.h"
#include "libtracker/ik/ik_solver.h"
#include "libtracker/skeleton/check_skeleton.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

constexpr double kLargestWeight = 1000;  // of a target; 1 is usual

IkConfig configOf(const IkOptions& options) {
  IkConfig config;
  config.method = options.method;
  config.prior = options.prior;
  config.weight_m = options.weight_m;
  config.validate();
  return config;
}

std::shared_ptr<const LearnedPoses> learnedPoses(const IkOptions& options) {
  if (!configOf(options).needsLearned()) return nullptr;
  return std::make_shared<const LearnedPoses>(
      loadLearnedPoses(options.learned_poses.empty() ? shippedFile("pose_priors.bin") : options.learned_poses));
}

const Skeleton& checked(const Skeleton& skeleton) {
  checkSkeleton(skeleton, "Actor");
  return skeleton;
}

// The fields are open to everybody: what was put in without add() is looked at as add() does.
void checkTargets(const JointTargets& targets) {
  if (targets.count() == 0) throw Error("there is no target", "JointTargets", "add at least one");
  JointTargets seen;
  for (std::size_t j = 0; j < kJointCount; ++j) {
    if (!targets.given[j]) continue;
    const std::string where = "JointTargets: " + std::string(kJointNames[j]);
    const std::string wrong = seen.add(static_cast<Joint>(j), targets.p_world.col(static_cast<int>(j)));
    if (!wrong.empty()) throw Error(wrong, where);
    const double weight = targets.weight[j];
    checkConfig(weight > 0 && weight <= kLargestWeight, where, "weight", weight, "above 0 and at most 1000");
  }
}

}  // namespace

struct Ik::Impl {
  Impl(const Skeleton& skeleton, const IkOptions& options)
      : solver(checked(skeleton), configOf(options), learnedPoses(options)) {}
  IkSolver solver;
};

Ik::Ik(const IkOptions& options) : impl_(std::make_unique<const Impl>(makeSkeleton(BoneLengths{}), options)) {}
Ik::Ik(const Actor& actor, const IkOptions& options) : impl_(std::make_unique<const Impl>(actor.skeleton, options)) {}
Ik::~Ik() = default;
Ik::Ik(Ik&&) noexcept = default;
Ik& Ik::operator=(Ik&&) noexcept = default;

IkResult Ik::solve(const JointTargets& targets) const {
  checkTargets(targets);
  return impl_->solver.solve(targets);
}

JointPositions Ik::joints(const Pose& q) const {
  return jointPositions(impl_->solver.skeleton(), q);
}

}  // namespace depthmocap

#include "apps/ik/setup.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include <fmt/format.h>

#include "depthmocap/actor.h"
#include "depthmocap/error.h"
#include "libtracker/core/shipped_files.h"

namespace depthmocap {
namespace {

template <typename Value, std::size_t N>
Value named(const std::array<std::string_view, N>& names, const std::string& name, const char* what) {
  const auto* const found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) {
    throw Error(fmt::format("there is no such {}", what), name, fmt::format("one of {}", fmt::join(names, " ")));
  }
  return static_cast<Value>(found - names.begin());
}

}  // namespace

void addIkOptions(CLI::App& command, IkCommandOptions& o) {
  command.add_option("--actor", o.actor, "Calibrated body (see calibrate); otherwise an average adult")
      ->type_name("A.json");
  command.add_option("--priors", o.priors, "Learned poses (see posedb learn-priors; default: those of the build)")
      ->type_name("FILE");
}

Skeleton ikSkeleton(const IkCommandOptions& options) {
  if (options.actor.empty()) return makeSkeleton(BoneLengths{});
  return readActorFile(options.actor).skeleton;
}

std::shared_ptr<const LearnedPoses> ikLearnedPoses(const IkCommandOptions& options) {
  return std::make_shared<const LearnedPoses>(
      loadLearnedPoses(options.priors.empty() ? shippedFile("pose_priors.bin") : options.priors));
}

IkMethod ikMethodNamed(const std::string& name) {
  return named<IkMethod>(kIkMethodNames, name, "solver");
}

IkPrior ikPriorNamed(const std::string& name) {
  return named<IkPrior>(kIkPriorNames, name, "prior");
}

IkPrior defaultPrior(IkMethod method) {
  return method == IkMethod::Lm ? IkPrior::Gmm : IkPrior::None;
}

}  // namespace depthmocap

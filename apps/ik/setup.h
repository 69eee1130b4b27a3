#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "libtracker/ik/ik_solver.h"

namespace CLI {
class App;
}

namespace depthmocap {

// Options of every command that solves for poses; empty = the default.
struct IkCommandOptions {
  std::filesystem::path actor;   // a calibrated body; otherwise the average adult
  std::filesystem::path priors;  // learned poses; otherwise those that come with the build
};

void addIkOptions(CLI::App& command, IkCommandOptions& options);

// The body of --actor, or the average one.
Skeleton ikSkeleton(const IkCommandOptions& options);
// What --priors names; Error where it is missing or damaged.
std::shared_ptr<const LearnedPoses> ikLearnedPoses(const IkCommandOptions& options);

// The value with this name, of those in ik_solver.h.
IkMethod ikMethodNamed(const std::string& name);
IkPrior ikPriorNamed(const std::string& name);
// The prior where none is named: the one that measured best (docs/lab/ik.md), none for a method that knows no prior.
IkPrior defaultPrior(IkMethod method);

}  // namespace depthmocap

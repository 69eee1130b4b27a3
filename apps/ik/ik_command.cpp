#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/ik/evaluate.h"
#include "apps/ik/setup.h"
#include "apps/terminal/output_check.h"
#include "apps/terminal/progress.h"
#include "libtracker/core/parallel.h"
#include "libtracker/ik/ik_files.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

struct SolveOptions : IkCommandOptions {
  fs::path targets;
  fs::path out;
  std::string prior;  // empty: the default of the solver
  std::string solver = "lm";
  double weight_m = IkConfig{}.weight_m;
  int threads = 2;
};

IkConfig configOf(const SolveOptions& o) {
  IkConfig config;
  config.method = ikMethodNamed(o.solver);
  config.prior = o.prior.empty() ? defaultPrior(config.method) : ikPriorNamed(o.prior);
  config.weight_m = o.weight_m;
  if (config.method != IkMethod::Lm && config.prior != IkPrior::None) {
    throw CLI::ValidationError("--prior", "the solver " + o.solver + " knows no prior; use --solver lm");
  }
  return config;
}

void solve(const SolveOptions& o) {
  if (o.targets.empty()) throw CLI::RequiredError("--targets");
  if (o.out.empty()) throw CLI::RequiredError("--out");
  const IkConfig config = configOf(o);
  OutputCheck check;
  for (const fs::path& input : {o.targets, o.actor, o.priors}) check.reads(input);
  check.writes("--out", o.out);
  const std::vector<PoseTargets> poses = readTargetsFile(o.targets);
  const IkSolver solver(ikSkeleton(o), config, config.prior == IkPrior::None ? nullptr : ikLearnedPoses(o));
  std::vector<IkResult> results(poses.size());
  Progress progress("poses", poses.size());
  const std::size_t block = 16 * static_cast<std::size_t>(o.threads);
  for (std::size_t first = 0; first < poses.size(); first += block) {
    const std::size_t count = std::min(block, poses.size() - first);
    parallelFor(o.threads, count, [&](std::size_t i) { results[first + i] = solver.solve(poses[first + i].targets); });
    progress.update(first + count);
  }
  writeSolvedPoses(poses, results, solver.skeleton(), o.out);
  double worst_m = 0;
  for (const IkResult& result : results) worst_m = std::max(worst_m, result.residual_m);
  std::cerr << fmt::format("{} poses, targets missed by at most {:.1f} mm (root mean square of a pose)\n", poses.size(),
                           1000.0 * worst_m);
}

}  // namespace

void addIkCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("ik", "Poses of the body from the places of some of its joints.");
  const auto o = std::make_shared<SolveOptions>();
  command->add_option("--targets", o->targets, "Targets, CSV: pose_id,joint,x,y,z; metres, y up")->type_name("T.csv");
  command->add_option("--out", o->out, "Poses to write, CSV: joints and degrees of freedom")->type_name("P.csv");
  command
      ->add_option("--prior", o->prior,
                   fmt::format("What says how natural a pose is; default: {} with lm, none with the others",
                               kIkPriorNames[static_cast<std::size_t>(defaultPrior(IkMethod::Lm))]))
      ->check(CLI::IsMember(std::vector<std::string>(kIkPriorNames.begin(), kIkPriorNames.end())));
  command->add_option("--solver", o->solver, "lm; jacobian, ccd and fabrik know no prior")
      ->check(CLI::IsMember(std::vector<std::string>(kIkMethodNames.begin(), kIkMethodNames.end())))
      ->capture_default_str();
  command
      ->add_option(
          "--weight", o->weight_m,
          "How far a joint may stay from its target for one unit of the prior [m]; for targets that are not exact: "
          "half of what each coordinate is off by")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  addIkOptions(*command, *o);
  command->add_option("--threads", o->threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->footer(
      "Joints: pelvis spine neck head, left_ and right_ shoulder elbow wrist hip knee ankle toe.\nExample:\n"
      "  depthmocap ik --targets targets.csv --out poses.csv --prior vae");
  addIkEvaluateCommand(*command);
  command->callback([o, command] {
    if (command->get_subcommands().empty()) solve(*o);
  });
}

}  // namespace depthmocap

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
#include "libtracker/ik/image_ik.h"
#include "libtracker/recording/recording_header.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

// The names of --v, in the order of VAxis.
const std::vector<std::string> kVNames = {"auto", "up", "down"};

struct SolveOptions : IkCommandOptions {
  fs::path targets;
  fs::path out;
  std::string projection;  // empty: targets are places in the world
  fs::path camera;
  std::string v_axis = "auto";
  double fps = 0;     // above 0: poses are successive pictures
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

std::vector<SolvedPose> solvePlaces(const SolveOptions& o, const IkSolver& solver) {
  const std::vector<PoseTargets> poses = readTargetsFile(o.targets);
  std::vector<SolvedPose> solved(poses.size());
  Progress progress("poses", poses.size());
  const std::size_t block = 16 * static_cast<std::size_t>(o.threads);
  for (std::size_t first = 0; first < poses.size(); first += block) {
    const std::size_t count = std::min(block, poses.size() - first);
    parallelFor(o.threads, count, [&](std::size_t k) {
      const std::size_t i = first + k;
      solved[i] = {poses[i].id, poses[i].targets.given, solver.solve(poses[i].targets), static_cast<double>(i)};
    });
    progress.update(first + count);
  }
  return solved;
}

ImageProjection projectionOf(const SolveOptions& o) {
  if (o.projection == "orthographic") {
    if (!o.camera.empty()) throw CLI::ValidationError("--camera", "is for --projection pinhole");
    return {Projection::Orthographic, {}};
  }
  if (o.camera.empty()) throw CLI::RequiredError("--camera (for --projection pinhole)");
  return {Projection::Pinhole, readRecordingHeader(o.camera).camera};
}

std::vector<SolvedPose> solvePictures(const SolveOptions& o, const IkSolver& solver) {
  const ImageProjection projection = projectionOf(o);
  const auto v_axis = static_cast<VAxis>(std::find(kVNames.begin(), kVNames.end(), o.v_axis) - kVNames.begin());
  const std::vector<PoseImageTargets> poses = readImageTargetsFile(o.targets, projection.kind, v_axis);
  std::vector<IkResult> results(poses.size());
  std::vector<double> time_s(poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) time_s[i] = static_cast<double>(i) / (o.fps > 0 ? o.fps : 1.0);
  if (o.fps > 0) {
    std::vector<ImageTargets> targets;
    targets.reserve(poses.size());
    for (const PoseImageTargets& pose : poses) targets.push_back(pose.targets);
    SequenceConfig config;
    config.threads = o.threads;
    results = solveImageSequence(solver, projection, targets, time_s, config);
  } else {
    parallelFor(o.threads, poses.size(),
                [&](std::size_t i) { results[i] = solveImage(solver, projection, poses[i].targets); });
  }
  std::vector<SolvedPose> solved;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    SolvedPose pose{poses[i].id, {}, results[i], time_s[i]};
    for (const auto& target : poses[i].targets.targets) pose.given[static_cast<std::size_t>(target.joint)] = true;
    solved.push_back(pose);
  }
  return solved;
}

void solve(const SolveOptions& o) {
  if (o.targets.empty()) throw CLI::RequiredError("--targets");
  if (o.out.empty()) throw CLI::RequiredError("--out");
  const IkConfig config = configOf(o);
  if (!o.projection.empty() && config.method != IkMethod::Lm) {
    throw CLI::ValidationError("--projection", "the solver " + o.solver + " knows no pictures; use --solver lm");
  }
  if (o.projection.empty() && o.fps > 0) throw CLI::ValidationError("--fps", "is for --projection");
  OutputCheck check;
  for (const fs::path& input : {o.targets, o.actor, o.priors, o.camera}) check.reads(input);
  check.writes("--out", o.out);
  const IkSolver solver(ikSkeleton(o), config, config.needsLearned() ? ikLearnedPoses(o) : nullptr);
  const std::vector<SolvedPose> poses = o.projection.empty() ? solvePlaces(o, solver) : solvePictures(o, solver);
  writeSolvedPoses(poses, solver.skeleton(), o.out);
  double worst_m = 0;
  for (const SolvedPose& pose : poses) worst_m = std::max(worst_m, pose.result.residual_m);
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
      ->add_option("--projection", o->projection,
                   "Targets are joints in a picture, CSV: pose_id,joint,u,v[,weight]; of unknown scale, or of --camera")
      ->check(CLI::IsMember({"orthographic", "pinhole"}));
  command->add_option("--camera", o->camera, "Intrinsics of the pinhole camera, as in a recording.json")
      ->type_name("C.json");
  command->add_option("--v", o->v_axis, "Where v grows in orthographic targets; auto: as heads and feet say")
      ->check(CLI::IsMember(kVNames))
      ->capture_default_str();
  command->add_option("--fps", o->fps, "Poses are successive pictures at this rate: solves them all at once")
      ->check(CLI::Range(0.1, 10000.0));
  command
      ->add_option("--prior", o->prior,
                   fmt::format("What says how natural a pose is; default: {} with lm, none with the others",
                               kIkPriorNames[static_cast<std::size_t>(defaultPrior(IkMethod::Lm))]))
      ->check(CLI::IsMember(std::vector<std::string>(kIkPriorNames.begin(), kIkPriorNames.end())));
  command
      ->add_option("--solver", o->solver,
                   "lm; latent: poses of the variational autoencoder alone; jacobian, ccd and fabrik know no prior")
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

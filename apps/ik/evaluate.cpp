#include "apps/ik/evaluate.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "apps/ik/picture.h"
#include "apps/ik/setup.h"
#include "apps/terminal/output_check.h"
#include "apps/terminal/progress.h"
#include "depthmocap/error.h"
#include "libtracker/ik/ik_experiment.h"

namespace depthmocap {
namespace {

constexpr std::array<int, 4> kJoints = {6, 8, 10, 15};  // those of the paper
constexpr std::array<double, 2> kNoise_m = {0.010, 0.030};
constexpr int kNoisyJoints = 15;
constexpr std::array<int, 5> kYaws_deg = {0, 45, 90, 135, 180};
constexpr int kPicturePoses = 200;  // at most: a picture is solved from twelve starts

struct EvaluateOptions : IkCommandOptions {
  std::filesystem::path database;
  std::filesystem::path picture;
  IkExperimentConfig experiment;
  int threads = 1;
};

class Tables {
 public:
  explicit Tables(const EvaluateOptions& o)
      : o_(o),
        database_(loadPoseDatabase(o.database)),
        skeleton_(ikSkeleton(o)),
        learned_(ikLearnedPoses(o)),
        progress_("measurements",
                  kIkPriorCount * (kJoints.size() + kNoise_m.size()) + 4 * kJoints.size() + 3 * kYaws_deg.size()) {
    if (database_.size() == 0) throw Error("holds no pose", o.database.string());
  }

  void print() {
    fmt::print("{} poses of {} ({})\n", o_.experiment.poses, o_.database.filename().string(), database_.origin);
    fmt::print("learned: {}\n\n", learned_->origin);
    fmt::print("Error of all joints [mm] and of bones' rotations [degrees], by prior and number of joints given:\n\n");
    header("prior");
    for (int prior = 0; prior < kIkPriorCount; ++prior) row(priorName(prior), configOf(static_cast<IkPrior>(prior)));
    fmt::print("\nThe same of the classic solvers, without a prior, and of latent IK:\n\n");
    header("solver");
    for (const IkMethod method : {IkMethod::Jacobian, IkMethod::Ccd, IkMethod::Fabrik, IkMethod::Latent}) {
      IkConfig config;
      config.method = method;
      row(kIkMethodNames[static_cast<std::size_t>(method)], config);
    }
    noise();
    pictures();
  }
  void draw() const {
    IkExperimentConfig config = o_.experiment;
    config.poses = 4;
    config.joints = kJoints.front();
    std::vector<IkSolver> solvers;
    solvers.reserve(kIkPriorCount);
    for (int prior = 0; prior < kIkPriorCount; ++prior) {
      solvers.emplace_back(skeleton_, configOf(static_cast<IkPrior>(prior)), learned_);
    }
    drawIkPicture(ikTasks(database_, skeleton_, config), solvers, o_.picture);
  }

 private:
  static std::string_view priorName(int prior) { return kIkPriorNames[static_cast<std::size_t>(prior)]; }
  static IkConfig configOf(IkPrior prior) {
    IkConfig config;
    config.prior = prior;
    return config;
  }
  static void header(const char* what) {
    fmt::print("| {} |", what);
    for (const int joints : kJoints) fmt::print(" {} joints |", joints);
    fmt::print(" targets missed by [mm] | a solve [ms] |\n|---|");
    for (std::size_t i = 0; i < kJoints.size() + 2; ++i) fmt::print("---|");
    fmt::print("\n");
  }
  IkFigures measured(const IkSolver& solver, int joints, double noise_m) {
    IkExperimentConfig config = o_.experiment;
    config.joints = joints;
    config.noise_m = noise_m;
    const IkFigures figures = measureIk(solver, ikTasks(database_, skeleton_, config), o_.threads);
    progress_.update(++done_);
    return figures;
  }
  void row(std::string_view name, const IkConfig& config) {
    const IkSolver solver(skeleton_, config, learned_);
    std::string line = fmt::format("| {} |", name);
    double residual_m = 0;
    double ms = 0;
    for (const int joints : kJoints) {
      const IkFigures f = measured(solver, joints, 0);
      line += fmt::format(" {:.1f} mm, {:.1f}° |", 1000.0 * f.position_m, f.rotation_deg);
      residual_m += f.residual_m / kJoints.size();
      ms += f.solve_ms / kJoints.size();
    }
    fmt::print("{} {:.1f} | {:.1f} |\n", line, 1000.0 * residual_m, ms);
  }
  void noise() {
    fmt::print(
        "\nThe same with {} joints given and noise on each coordinate of their targets; the prior's weight is half the "
        "noise:\n\n| prior |",
        kNoisyJoints);
    for (const double noise_m : kNoise_m) fmt::print(" {:.0f} mm |", 1000.0 * noise_m);
    fmt::print("\n|---|---|---|\n");
    for (int prior = 0; prior < kIkPriorCount; ++prior) {
      std::string line = fmt::format("| {} |", priorName(prior));
      for (const double noise_m : kNoise_m) {
        IkConfig config = configOf(static_cast<IkPrior>(prior));
        config.weight_m = 0.5 * noise_m;
        const IkSolver solver(skeleton_, config, learned_);
        const IkFigures f = measured(solver, kNoisyJoints, noise_m);
        line += fmt::format(" {:.1f} mm, {:.1f}° |", 1000.0 * f.position_m, f.rotation_deg);
      }
      fmt::print("{}\n", line);
    }
  }
  void pictures() {
    IkExperimentConfig config = o_.experiment;
    config.poses = std::min(config.poses, kPicturePoses);
    const std::vector<IkTask> tasks = ikTasks(database_, skeleton_, config);
    fmt::print(
        "\nFrom pictures in scaled orthographic projection, all 18 joints given, of {} poses that face so many degrees "
        "away from the viewer:\n\n| prior |",
        config.poses);
    for (const int yaw_deg : kYaws_deg) fmt::print(" {}° |", yaw_deg);
    fmt::print(" a solve [ms] |\n|---|");
    for (std::size_t i = 0; i < kYaws_deg.size() + 1; ++i) fmt::print("---|");
    fmt::print("\n");
    for (const IkPrior prior : {IkPrior::None, IkPrior::Ppca, IkPrior::Gmm}) {
      const IkSolver solver(skeleton_, configOf(prior), learned_);
      std::string line = fmt::format("| {} |", priorName(static_cast<int>(prior)));
      double ms = 0;
      for (const int yaw_deg : kYaws_deg) {
        const IkFigures f = measureImageIk(solver, tasks, yaw_deg * std::numbers::pi / 180.0, o_.threads);
        line += fmt::format(" {:.1f} mm, {:.1f}° |", 1000.0 * f.position_m, f.rotation_deg);
        ms += f.solve_ms / static_cast<double>(kYaws_deg.size());
        progress_.update(++done_);
      }
      fmt::print("{} {:.1f} |\n", line, ms);
    }
  }

  const EvaluateOptions& o_;
  PoseDatabase database_;
  Skeleton skeleton_;
  std::shared_ptr<const LearnedPoses> learned_;
  Progress progress_;
  std::size_t done_ = 0;
};

void evaluate(const EvaluateOptions& o) {
  OutputCheck check;
  for (const std::filesystem::path& input : {o.database, o.actor, o.priors}) check.reads(input);
  check.writes("--picture", o.picture);
  Tables tables(o);
  tables.print();
  if (!o.picture.empty()) tables.draw();
}

}  // namespace

void addIkEvaluateCommand(CLI::App& ik) {
  CLI::App* command = ik.add_subcommand("evaluate", "Measures priors and solvers on the poses of a database.");
  const auto o = std::make_shared<EvaluateOptions>();
  command->add_option("--posedb", o->database, "Pose database that nothing was learned from")
      ->required()
      ->type_name("DB");
  command->add_option("--poses", o->experiment.poses, "Poses to draw from it")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", o->experiment.seed, "Of the poses, the joints and the noise")->capture_default_str();
  command->add_option("--picture", o->picture, "Draws a few poses beside the truth, PNG")->type_name("P.png");
  addIkOptions(*command, *o);
  command->add_option("--threads", o->threads, "Threads; the errors do not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->callback([o] { evaluate(*o); });
}

}  // namespace depthmocap

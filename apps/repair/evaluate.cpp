#include "apps/repair/evaluate.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "apps/terminal/progress.h"
#include "depthmocap/error.h"
#include "libtracker/core/parallel.h"
#include "libtracker/core/shipped_files.h"
#include "libtracker/motion/motion_files.h"
#include "libtracker/repair/repair_experiment.h"

namespace depthmocap {
namespace {

constexpr std::array<int, 4> kMissing = {1, 3, 5, 10};
constexpr std::array<double, 4> kGaps_s = {0.1, 0.5, 1.0, 2.0};
constexpr std::array<double, 4> kNoise_m = {0.005, 0.010, 0.020, 0.050};

struct EvaluateOptions {
  std::vector<std::filesystem::path> motions;
  std::filesystem::path priors;
  double seconds = 15.0;
  std::uint64_t seed = 1;
  int threads = 2;
};

class Tables {
 public:
  explicit Tables(const EvaluateOptions& o)
      : o_(o),
        learned_(std::make_shared<const LearnedPoses>(
            loadLearnedPoses(o.priors.empty() ? shippedFile("pose_priors.bin") : o.priors))),
        progress_("measurements", 4 * kMissing.size() * kGaps_s.size() + 4 * kNoise_m.size() + 4 * kNoise_m.size()) {
    for (const auto& path : o.motions) {
      const RetargetResult motion = retargetMotionFile(path);
      const auto longest = static_cast<std::size_t>(o.seconds * motion.clip.fps);
      std::vector<JointPositions> joints = motion.source_joints;
      joints.resize(std::min(joints.size(), longest));
      truths_.push_back(jointMarkers(joints, motion.clip.fps));
    }
  }

  void print() {
    double seconds = 0;
    for (const MarkerSequence& truth : truths_) seconds += truth.time_s.back();
    fmt::print("{} motions, {:.0f} s of them, the 18 joints of their own skeletons\n", truths_.size(), seconds);
    fmt::print("learned: {}\n", learned_->origin);
    gaps();
    noise();
    both();
    fmt::print("\n`repair` takes {:.1f} ms a frame on one core.\n", 1000.0 * ours_s_ / ours_frames_);
  }

 private:
  RepairError measured(RepairMethod method, RepairTrial trial) {
    std::vector<RepairError> errors(truths_.size());
    const auto start = std::chrono::steady_clock::now();
    parallelFor(o_.threads, truths_.size(), [&](std::size_t i) {
      RepairTrial own = trial;
      own.seed = o_.seed + i;
      const MarkerSequence markers = damaged(truths_[i], own);
      RepairConfig config;
      config.sequence.threads = 1;
      errors[i] = repairError(truths_[i], markers, repairedBy(method, markers, learned_, config));
    });
    if (method == RepairMethod::Ours) {
      ours_s_ += o_.threads * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      for (const MarkerSequence& truth : truths_) ours_frames_ += static_cast<double>(truth.frames());
    }
    RepairError mean;
    double with_gaps = 0;
    for (const RepairError& error : errors) {
      mean.all_m += error.all_m / static_cast<double>(errors.size());
      mean.missing_m += error.missing_m;
      with_gaps += error.missing_m > 0 ? 1 : 0;  // a short motion may have no room for a gap
    }
    if (with_gaps > 0) mean.missing_m /= with_gaps;
    progress_.update(++done_);
    return mean;
  }
  static std::string_view nameOf(RepairMethod method) { return kRepairMethodNames[static_cast<std::size_t>(method)]; }

  void gaps() {
    fmt::print("\nMean error of what is missing [mm]:\n\n| markers missing | method |");
    for (const double gap_s : kGaps_s) fmt::print(" {:g} s |", gap_s);
    fmt::print("\n|---|---|---|---|---|---|\n");
    for (const int missing : kMissing) {
      for (const auto method : {RepairMethod::Linear, RepairMethod::Spline, RepairMethod::Pca, RepairMethod::Ours}) {
        std::string line = fmt::format("| {} | {} |", missing, nameOf(method));
        for (const double gap_s : kGaps_s) {
          line += fmt::format(" {:.1f} |", 1000.0 * measured(method, {missing, gap_s, 0, 1}).missing_m);
        }
        fmt::print("{}\n", line);
      }
    }
  }
  void noise() {
    fmt::print(
        "\nMean error of all markers [mm], nothing missing, with noise of this deviation on each coordinate:\n\n");
    header("method");
    std::string raw = "| as they are |";
    for (const double noise_m : kNoise_m) {
      // The mean length of a normal vector is sqrt(8 / pi) deviations.
      raw += fmt::format(" {:.1f} |", 1000.0 * noise_m * 1.5958);
    }
    fmt::print("{}\n", raw);
    for (const auto method : {RepairMethod::LowPass, RepairMethod::Pca, RepairMethod::Ours}) {
      std::string line = fmt::format("| {} |", nameOf(method));
      for (const double noise_m : kNoise_m) {
        line += fmt::format(" {:.1f} |", 1000.0 * measured(method, {0, 0, noise_m, 1}).all_m);
      }
      fmt::print("{}\n", line);
    }
  }
  void both() {
    fmt::print("\nMean error of what is missing [mm], five markers for 0.5 s, with noise on the others:\n\n");
    header("method");
    for (const auto method : {RepairMethod::Linear, RepairMethod::Spline, RepairMethod::Pca, RepairMethod::Ours}) {
      std::string line = fmt::format("| {} |", nameOf(method));
      for (const double noise_m : kNoise_m) {
        line += fmt::format(" {:.1f} |", 1000.0 * measured(method, {5, 0.5, noise_m, 1}).missing_m);
      }
      fmt::print("{}\n", line);
    }
  }
  static void header(const char* what) {
    fmt::print("| {} |", what);
    for (const double noise_m : kNoise_m) fmt::print(" {:.0f} mm |", 1000.0 * noise_m);
    fmt::print("\n|---|---|---|---|---|\n");
  }

  const EvaluateOptions& o_;
  std::shared_ptr<const LearnedPoses> learned_;
  std::vector<MarkerSequence> truths_;
  Progress progress_;
  std::size_t done_ = 0;
  double ours_s_ = 0;
  double ours_frames_ = 0;
};

}  // namespace

void addRepairEvaluateCommand(CLI::App& repair) {
  CLI::App* command = repair.add_subcommand("evaluate", "Measures repair against linear, spline and PCA filling.");
  const auto o = std::make_shared<EvaluateOptions>();
  command->add_option("motions", o->motions, "Motion files (.amc, .bvh) that nothing was learned from")
      ->required()
      ->type_name("MOTION...");
  command->add_option("--seconds", o->seconds, "Of each motion, at most")
      ->check(CLI::Range(3.0, 3600.0))
      ->capture_default_str();
  command->add_option("--seed", o->seed, "Of gaps and noise")->capture_default_str();
  command->add_option("--priors", o->priors, "Learned poses (default: those of the build)")->type_name("FILE");
  command->add_option("--threads", o->threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->callback([o] { Tables(*o).print(); });
}

}  // namespace depthmocap

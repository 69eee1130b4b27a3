#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/terminal/motion_options.h"
#include "apps/terminal/output_check.h"
#include "apps/terminal/progress.h"
#include "apps/terminal/warnings.h"
#include "depthmocap/error.h"
#include "forest/pose_model/fit_pose_mixture.h"
#include "forest/pose_model/learn_poses.h"
#include "libtracker/choreography/procedural_motions.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/parallel.h"
#include "libtracker/motion/motion_files.h"
#include "libtracker/posedb/pose_database.h"
#include "libtracker/posedb_build/compose_pose_database.h"
#include "libtracker/posedb_build/pose_mixture.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr double kMegabyte = 1e6;

struct BuildOptions {
  std::vector<fs::path> motions;
  bool procedural = false;
  fs::path out;
  std::vector<std::string> exclude;
  std::string mirror = "on";
  double threshold_m = PoseDatabaseConfig{}.threshold_m;
  LoadOptions load;
  fs::path samples;  // pose mixture to draw from; empty = none
  std::size_t sample_count = 30000;
  std::uint64_t seed = 1;
  int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
};

// What has been read, for the summary.
struct ReadMotions {
  std::vector<MotionClip> clips;
  std::size_t captured = 0;  // of the clips, those from files
  std::size_t broken = 0;
  double residual_sum = 0;  // [m] of the captured clips' mean joint residuals, weighted by frames
  std::size_t captured_frames = 0;
};

// Takes the excluded names off a list; Error for a name that is not on it.
template <typename Item, typename NameOf>
void exclude(std::vector<Item>& items, std::vector<std::string>& pending, NameOf nameOf,
             const std::vector<std::string>& names) {
  std::erase_if(items, [&](const Item& item) {
    const std::string name = nameOf(item);
    if (std::find(names.begin(), names.end(), name) == names.end()) return false;
    std::erase(pending, name);
    return true;
  });
}

// Reads and retargets the files on all threads. Returns why broken ones were left out.
std::vector<std::string> readFiles(const std::vector<fs::path>& files, const BuildOptions& o, ReadMotions& read) {
  const std::size_t block = 4 * static_cast<std::size_t>(o.threads);
  Progress progress("motions", std::max<std::size_t>(1, files.size()));
  std::vector<std::string> warnings;
  for (std::size_t first = 0; first < files.size(); first += block) {
    const std::size_t count = std::min(block, files.size() - first);
    std::vector<std::optional<RetargetResult>> results(count);
    std::vector<std::string> failures(count);
    parallelFor(o.threads, count, [&](std::size_t i) {
      try {
        results[i] = retargetMotionFile(files[first + i], o.load);
      } catch (const Error& error) {
        failures[i] = error.what();
      }
    });
    for (std::size_t i = 0; i < count; ++i) {
      if (!results[i]) {
        warnings.push_back(failures[i]);
        continue;
      }
      printMotionWarnings(files[first + i], results[i]->warnings);
      const std::size_t frames = results[i]->clip.poses.size();
      read.residual_sum += results[i]->residuals.mean() * static_cast<double>(frames);
      read.captured_frames += frames;
      read.clips.push_back(std::move(results[i]->clip));
      ++read.captured;
    }
    progress.update(first + count);
  }
  return warnings;
}

ReadMotions readMotions(const BuildOptions& o) {
  std::vector<std::string> pending = o.exclude;
  std::vector<fs::path> files;
  for (const fs::path& folder : o.motions) {
    const auto found = findMotionFiles(folder);
    if (found.empty()) throw Error("there is no .amc or .bvh file in this folder", folder.string());
    files.insert(files.end(), found.begin(), found.end());
  }
  exclude(
      files, pending, [](const fs::path& file) { return file.stem().string(); }, o.exclude);
  std::vector<MotionClip> procedural;
  if (o.procedural) procedural = proceduralMotions(o.seed);
  exclude(
      procedural, pending, [](const MotionClip& clip) { return clip.name; }, o.exclude);
  if (!pending.empty()) {
    throw Error("no motion has this name", "--exclude " + pending.front(),
                "names are those of the files without extension");
  }
  ReadMotions read;
  const std::vector<std::string> warnings = readFiles(files, o, read);
  for (const std::string& warning : warnings) warn("left out " + warning);
  read.broken = warnings.size();
  for (MotionClip& clip : procedural) read.clips.push_back(std::move(clip));
  if (read.clips.empty()) throw Error("none of the motions can be read", "posedb build", "see the warnings above");
  return read;
}

void build(const BuildOptions& o) {
  if (o.motions.empty() && !o.procedural) {
    throw CLI::RequiredError("--motions DIR or --procedural");
  }
  OutputCheck check;
  check.reads(o.samples);
  for (const fs::path& folder : o.motions) readsMotions(check, folder, o.load);
  check.writes("--out", o.out);
  const PoseMixture mixture = o.samples.empty() ? PoseMixture{} : loadPoseMixture(o.samples);
  const auto start = std::chrono::steady_clock::now();
  ReadMotions read = readMotions(o);
  const std::size_t procedural = read.clips.size() - read.captured;
  const PoseDatabaseSources sources{std::move(read.clips), read.captured, o.procedural, o.exclude, mixture,
                                    o.sample_count,        o.seed};
  PoseDatabaseConfig config;
  config.threshold_m = o.threshold_m;
  config.mirror = o.mirror == "on";
  config.threads = o.threads;
  const PoseDatabaseResult result = composePoseDatabase(sources, config);
  savePoseDatabase(result.database, o.out);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("motions      {} read, {} broken, {} procedural\n", read.captured, read.broken, procedural);
  if (read.captured_frames > 0) {
    fmt::print("residual     {:.1f} mm mean over joints and frames\n",
               1000.0 * read.residual_sum / static_cast<double>(read.captured_frames));
  }
  fmt::print("frames       {}{}, {} beyond the joint limits\n", result.counts.frames,
             config.mirror ? " with mirror images" : "", result.counts.beyond_limits);
  fmt::print("poses        {} kept\n", result.counts.kept);
  if (!o.samples.empty()) fmt::print("samples      {}\n", o.sample_count);
  fmt::print("file         {}, {:.1f} MB\n", o.out.string(), static_cast<double>(fs::file_size(o.out)) / kMegabyte);
  fmt::print("time         {:.1f} s\n", seconds);
}

struct LearnOptions {
  fs::path database;
  fs::path out;
  PoseMixtureConfig config;
};

void learn(const LearnOptions& o) {
  OutputCheck check;
  check.reads(o.database);
  check.writes("--out", o.out);
  const PoseDatabase database = loadPoseDatabase(o.database);
  PoseMixture mixture = fitPoseMixture(database, o.config);
  mixture.origin = fmt::format("learned from {} poses: {}", database.size(), database.origin);
  savePoseMixture(mixture, o.out);
  fmt::print("poses        {}\n", database.size());
  fmt::print("components   {}\n", mixture.components.size());
  fmt::print("file         {}, {:.2f} MB\n", o.out.string(), static_cast<double>(fs::file_size(o.out)) / kMegabyte);
}

struct LearnPriorsOptions {
  fs::path database;
  fs::path out;
  fs::path check;  // pose database to measure on; empty = none
  fs::path report;
  PoseLearningConfig config;
};

void learnPriors(const LearnPriorsOptions& o) {
  OutputCheck outputs;
  outputs.reads(o.database);
  outputs.reads(o.check);
  outputs.writes("--out", o.out);
  outputs.writes("--report", o.report);
  const PoseDatabase database = loadPoseDatabase(o.database);
  const PoseDatabase check = o.check.empty() ? PoseDatabase{} : loadPoseDatabase(o.check);
  const auto start = std::chrono::steady_clock::now();
  std::optional<Progress> progress;
  LearnedPoses learned = learnPoses(database, o.config, [&](std::size_t done, std::size_t total) {
    if (!progress) progress.emplace("steps", total);
    progress->update(done);
  });
  progress.reset();
  const PoseLearningConfig& c = o.config;
  learned.origin = fmt::format(
      "learned from {} poses: {}; components {}, width {}, code {}, latent {}, noise {}, kl weight {}, epochs {}, "
      "batch {}, learning rate {}, seed {}",
      database.size(), database.origin, c.components, c.width, c.code, c.latent, c.noise, c.kl_weight, c.epochs,
      c.batch, c.learning_rate, c.seed);
  saveLearnedPoses(learned, o.out);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const auto errors = [&](const char* of, const PoseDatabase& poses) {
    const PoseLearningError e = learningError(learned, poses);
    return fmt::format("{:<12} ppca {:.3f}, autoencoder {:.3f}, vae {:.3f}\n", of, e.ppca, e.autoencoder,
                       e.variational);
  };
  std::string report = fmt::format("{}\n\ntime         {:.0f} s\nfile         {:.2f} MB\n", learned.origin, seconds,
                                   static_cast<double>(fs::file_size(o.out)) / kMegabyte);
  report += "reconstruction error (RMS, in standard deviations per DoF):\n";
  report += errors("learned", database);
  if (check.size() > 0) report += errors("others", check);
  fmt::print("{}", report);
  if (!o.report.empty()) writeFileAtomically(o.report, report);
}

struct InfoOptions {
  fs::path file;
  bool sources = false;
};

void info(const InfoOptions& o) {
  const PoseDatabase database = loadPoseDatabase(o.file);
  fmt::print("poses        {}\n", database.size());
  fmt::print("sources      {}\n", database.sources.size());
  fmt::print("origin       {}\n", database.origin);
  fmt::print("file         {}, {:.1f} MB\n", o.file.string(), static_cast<double>(fs::file_size(o.file)) / kMegabyte);
  if (!o.sources) return;
  for (const PoseDatabase::Source& source : database.sources) fmt::print("{:>8}  {}\n", source.count, source.name);
}

void addBuild(CLI::App& posedb) {
  auto* command = posedb.add_subcommand("build", "Motion capture files (ASF/AMC, BVH) to a pose database");
  auto o = std::make_shared<BuildOptions>();
  command->add_option("--motions", o->motions, "Folder of .amc (with their .asf) and .bvh files, searched recursively")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->add_flag("--procedural", o->procedural, "Add this program's own procedural motions");
  command->add_option("--out", o->out, "Pose database to write")->required()->type_name("DB");
  command->add_option("--exclude", o->exclude, "Leave out the motion of this name (16_32); may be repeated")
      ->type_name("NAME")
      ->allow_extra_args(false);
  command->add_option("--mirror", o->mirror, "Also take every motion's mirror image")
      ->check(CLI::IsMember({"on", "off"}))
      ->capture_default_str();
  command->add_option("--threshold", o->threshold_m, "Poses whose joints all lie nearer than this [m] are one")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  addMotionOptions(*command, o->load);
  command->add_option("--samples", o->samples, "Add poses drawn from this pose mixture (posedb learn)")
      ->type_name("FILE");
  command->add_option("--sample-count", o->sample_count, "Poses to draw")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  command->add_option("--seed", o->seed, "Of the procedural motions and the samples")->capture_default_str();
  command->add_option("--threads", o->threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->callback([o] { build(*o); });
}

void addLearn(CLI::App& posedb) {
  auto* command = posedb.add_subcommand("learn", "Fit a pose mixture to a pose database: statistics, no pose itself");
  auto o = std::make_shared<LearnOptions>();
  command->add_option("--posedb", o->database, "Pose database to learn from")->required()->type_name("DB");
  command->add_option("--out", o->out, "Pose mixture to write")->required()->type_name("FILE");
  command->add_option("--components", o->config.components, "Clusters to start from; small ones are dissolved")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command->add_option("--seed", o->config.seed, "Of the first clusters")->capture_default_str();
  command->add_option("--threads", o->config.threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->callback([o] { learn(*o); });
}

void addLearnPriors(CLI::App& posedb) {
  auto* command = posedb.add_subcommand("learn-priors", "Learn what `ik` knows of natural poses: statistics, networks");
  auto o = std::make_shared<LearnPriorsOptions>();
  command->add_option("--posedb", o->database, "Pose database to learn from")->required()->type_name("DB");
  command->add_option("--out", o->out, "File of learned poses to write")->required()->type_name("FILE");
  command->add_option("--check", o->check, "Pose database to measure on, of other motions")->type_name("DB");
  command->add_option("--report", o->report, "Also write what is printed to this file")->type_name("FILE");
  const auto option = [&](const char* name, auto& value, const char* text) {
    command->add_option(name, value, text)->capture_default_str();
  };
  option("--components", o->config.components, "Gaussians of the mixture to start from; small ones are dissolved");
  option("--width", o->config.width, "Neurons of each hidden layer");
  option("--code", o->config.code, "Size of the autoencoder's code");
  option("--latent", o->config.latent, "Size of the variational autoencoder's code");
  option("--noise", o->config.noise, "Noise on the autoencoder's inputs [deviations]; 0: a plain autoencoder");
  option("--kl-weight", o->config.kl_weight, "Of the Kullback-Leibler divergence against the squared error of a DoF");
  option("--epochs", o->config.epochs, "Passes over all poses");
  option("--batch", o->config.batch, "Poses of a step");
  option("--learning-rate", o->config.learning_rate, "Of the first steps; falls to 0 along half a cosine");
  option("--seed", o->config.seed, "Of first weights, order and noise");
  option("--threads", o->config.threads, "Threads; the result does not depend on it");
  command->callback([o] { learnPriors(*o); });
}

void addInfo(CLI::App& posedb) {
  auto* command = posedb.add_subcommand("info", "What a pose database holds");
  auto o = std::make_shared<InfoOptions>();
  command->add_option("DB", o->file, "Pose database")->required();
  command->add_flag("--sources", o->sources, "List the motions and how many poses each gave");
  command->callback([o] { info(*o); });
}

}  // namespace

void addPosedbCommand(CLI::App& app) {
  auto* posedb = app.add_subcommand("posedb", "Build, learn from and inspect pose databases");
  posedb->require_subcommand(1);
  addBuild(*posedb);
  addLearn(*posedb);
  addLearnPriors(*posedb);
  addInfo(*posedb);
}

}  // namespace depthmocap

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/learn/forest_commands.h"
#include "apps/learn/forest_data.h"
#include "apps/terminal/output_check.h"
#include "apps/terminal/progress.h"
#include "depthmocap/error.h"
#include "forest/train/communicator.h"
#include "forest/train/forest_accuracy.h"
#include "forest/train/forest_trainer.h"
#include "forest/train/training_report.h"
#include "libtracker/classify/forest_file.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr int kProgressSteps = 1000;

fs::path reportStem(fs::path out) {
  return out.replace_extension();
}

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct TrainCommand {
  DataOptions data;
  ForestTrainingOptions training;
  std::string out;
  std::string checkpoint_folder;
  std::size_t images = 20000;
  std::size_t validation_images = 300;
  double memory_gb = 8;
  FinishOptions finish;
  bool image_curve = false;
  std::string command_line;
};

// A line for each stage where stderr is no terminal, as in a log.
class TrainingLog {
 public:
  void operator()(const std::string& stage, double done) {
    const std::lock_guard lock(mutex_);
    bar_.update(static_cast<std::size_t>(done * kProgressSteps));
    if (stage == stage_) return;
    stage_ = stage;
    std::cerr << fmt::format("{}: {:.0f} s after the start\n", stage, secondsSince(start_));
  }

 private:
  std::mutex mutex_;
  Progress bar_{"training", kProgressSteps};
  std::string stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void measureCurves(const TrainCommand& c, const std::vector<TrainedTree>& trained, const Forest& forest,
                   TrainingImageSource& validation, TrainingReport& report) {
  const auto with = [&](auto&& change) {
    FinishOptions options = c.finish;
    change(options);
    return finishedForest(trained, options, "");
  };
  std::vector<Forest> smaller{forest};
  std::vector<CurvePoint*> points{nullptr};
  report.by_trees.resize(trained.size());
  for (std::size_t t = 0; t < trained.size(); ++t) {
    report.by_trees[t].x = static_cast<double>(t + 1);
    smaller.push_back(with([&](FinishOptions& o) { o.trees = t + 1; }));
    points.push_back(&report.by_trees[t]);
  }
  std::vector<int> depths;
  for (int depth = 4; depth <= c.training.tree.depth; depth += 3) depths.push_back(depth);
  report.by_depth.resize(depths.size());
  for (std::size_t i = 0; i < depths.size(); ++i) {
    report.by_depth[i].x = depths[i];
    smaller.push_back(with([&](FinishOptions& o) { o.depth = depths[i]; }));
    points.push_back(&report.by_depth[i]);
  }
  Progress bar("measuring", validation.count());
  const auto results = measureAccuracy(smaller, validation, 2, c.data.threads, [&](double done) {
    bar.update(static_cast<std::size_t>(done * static_cast<double>(validation.count())));
  });
  report.accuracy = results[0];
  for (std::size_t i = 1; i < results.size(); ++i) points[i]->mean_accuracy = results[i].all.meanAccuracy();
}

// One tree each from ever fewer images.
void measureImageCurve(const TrainCommand& c, ImageSet& images, TrainingImageSource& validation,
                       TrainingReport& report) {
  for (const std::size_t part : {64U, 16U, 4U}) {
    const std::unique_ptr<TrainingImageSource> source = images.first(std::max<std::size_t>(1, c.images / part));
    ForestTrainingOptions options = c.training;
    options.trees = 1;
    options.checkpoint.clear();
    options.resume = false;
    SingleCommunicator alone;
    const auto trained = trainForest(*source, alone, options, [](const std::string&, double) {});
    const Forest forest = finishedForest(trained, c.finish, "");
    const auto result = measureAccuracy({&forest, 1}, validation, 2, c.data.threads, [](double) {});
    report.by_images.push_back({static_cast<double>(source->count()), result[0].all.meanAccuracy()});
  }
  report.by_images.push_back({static_cast<double>(c.images), report.by_trees[0].mean_accuracy});
}

// What can be said before hours of work are done.
void prepareTraining(TrainCommand& c) {
  c.training.seed = c.data.seed;
  c.training.threads = c.data.threads;
  c.training.memory_bytes = static_cast<std::size_t>(c.memory_gb * 1e9);
  const fs::path out(c.out);
  OutputCheck check;
  readsData(check, c.data);
  check.writes("--out", out);
  for (const fs::path& report : trainingReportFiles(reportStem(out))) check.writes("the report", report);
  check.writesFolder("--checkpoint", c.checkpoint_folder);
  if (!c.checkpoint_folder.empty()) {
    fs::create_directories(c.checkpoint_folder);
    c.training.checkpoint = fs::path(c.checkpoint_folder) / out.stem().replace_extension(".checkpoint");
  }
  if (c.data.t_pose) c.finish.facings = 1;  // all of them are seen from the front
  c.training.validate();
}

void runTrain(TrainCommand c) {
  prepareTraining(c);
  const auto start = std::chrono::steady_clock::now();
  const std::unique_ptr<Communicator> ranks = makeCommunicator();
  const bool is_first = ranks->rank() == 0;
  ImageSet images = makeImageSet(c.data, PoseUse::Train, c.images);
  ImageSet held_out = makeImageSet(c.data, PoseUse::Validate, c.validation_images);
  if (is_first) std::cerr << "data: " << images.source->description() << '\n';
  TrainingReport report;
  TrainingLog log;
  const auto trained = trainForest(*images.source, *ranks, c.training, [&](const std::string& stage, double done) {
    if (stage == "rendering") report.render_s = secondsSince(start);
    if (is_first) log(stage, done);
  });
  if (!is_first) return;
  report.training_s = secondsSince(start) - report.render_s;
  const Forest forest = finishedForest(trained, c.finish, images.source->description());
  saveForest(forest, c.out);
  const fs::path stem = reportStem(c.out);
  report.title = stem.filename().string();
  report.command = c.command_line;
  report.data = images.source->description();
  report.validation = held_out.source->description() + ", all held out";
  measureCurves(c, trained, forest, *held_out.source, report);
  if (c.image_curve) measureImageCurve(c, images, *held_out.source, report);
  writeTrainingReport(report, forest, fs::file_size(c.out), stem);
  std::cout << fmt::format("{}: mean accuracy {:.1f} % over the parts, {:.1f} % of the pixels\n", c.out,
                           100 * report.accuracy.all.meanAccuracy(), 100 * report.accuracy.all.accuracy());
}

// The command as given, files by their names alone: the report is read elsewhere.
std::string commandLine(const CLI::App& command) {
  std::string line = "depthmocap forest train";
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    line += " " + option->get_name();
    if (option->get_expected_max() == 0) continue;
    for (const std::string& value : option->results()) line += " " + fs::path(value).filename().string();
  }
  return line;
}

}  // namespace

void addForestTrain(CLI::App& forest) {
  auto c = std::make_shared<TrainCommand>();
  CLI::App* command = forest.add_subcommand("train", "Trains a forest on rendered people");
  TreeOptions& tree = c->training.tree;
  command->add_option("--out", c->out, "Forest file; a report is written beside it")->required();
  command->add_option("--trees", c->training.trees)->capture_default_str();
  command->add_option("--depth", tree.depth, "Of a tree")->capture_default_str();
  command->add_option("--images", c->images, "Rendered images")->capture_default_str();
  command->add_option("--pixels", tree.pixels_per_image, "Pixels a tree learns from in each image")
      ->capture_default_str();
  command->add_option("--candidates", tree.candidates, "Features tried at each node")->capture_default_str();
  command->add_option("--offsets", tree.features.offsets, "Probes that a level's features are pairs of")
      ->capture_default_str();
  command->add_option("--max-offset", tree.features.max_offset, "[px * m at 525 px] longest probe")
      ->capture_default_str();
  command->add_option("--min-leaf", tree.min_leaf, "Pixels in a leaf")->capture_default_str();
  command->add_option("--facing-weight", tree.facing_weight, "[1/8] of telling the seen side apart, beside the parts")
      ->capture_default_str();
  command->add_option("--max-nodes", tree.max_nodes, "Of a tree")->capture_default_str();
  command->add_option("--probability-steps", c->finish.probability_steps, "Levels of a leaf's probabilities (1 .. 255)")
      ->check(CLI::Range(1, 255))
      ->capture_default_str();
  command->add_option("--memory", c->memory_gb, "[GB] of images kept in memory")->capture_default_str();
  command->add_option("--validation-images", c->validation_images)->capture_default_str();
  command->add_flag("--image-curve", c->image_curve, "Also train on fewer images, for the learning curve");
  command->add_option("--checkpoint", c->checkpoint_folder, "Folder for what is needed to resume");
  command->add_flag("--resume", c->training.resume, "Go on from the checkpoint");
  addDataOptions(*command, c->data);
  command->callback([c, command] {
    c->command_line = commandLine(*command);
    runTrain(*c);
  });
}

}  // namespace depthmocap

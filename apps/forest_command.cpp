#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/progress.h"
#include "forest/motions/procedural_motions.h"
#include "forest/train/forest_accuracy.h"
#include "forest/train/forest_trainer.h"
#include "forest/train/recorded_image_source.h"
#include "forest/train/rendered_image_source.h"
#include "forest/train/training_report.h"
#include "libtracker/core/error.h"
#include "libtracker/posedb/pose_database.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kValidationSeed = 1'000'000;  // added to the seed: bodies and views that training never sees
constexpr double kThinning = 0.10;                    // [rad] poses of a motion that differ less are one pose
constexpr int kProgressSteps = 1000;

// Where images come from; shared by train and evaluate.
struct DataOptions {
  std::vector<std::string> pose_databases;
  bool procedural = false;
  std::string makehuman;
  bool t_pose = false;
  std::vector<std::string> exclude;
  int bodies = 200;
  std::uint64_t seed = 1;
  int threads = 2;
};

void addDataOptions(CLI::App& command, DataOptions& data) {
  command.add_option("--posedb", data.pose_databases, "Pose databases to take poses from")->check(CLI::ExistingFile);
  command.add_flag("--procedural", data.procedural,
                   "Take poses from the procedural motions (default without --posedb)");
  command.add_option("--makehuman", data.makehuman, "Folder of the MakeHuman base mesh: half of the bodies are its")
      ->check(CLI::ExistingDirectory);
  command.add_flag("--tpose", data.t_pose, "T-poses facing the camera: the forest of the actor calibration");
  command.add_option("--exclude", data.exclude,
                     "Motions to hold out for measuring (default: a tenth of all motions, chosen by name)");
  command.add_option("--bodies", data.bodies, "Bodies to render")->check(CLI::Range(1, 10000))->capture_default_str();
  command.add_option("--seed", data.seed, "Of everything random")->capture_default_str();
  command.add_option("--threads", data.threads)->check(CLI::Range(1, 256))->capture_default_str();
}

PosePool makePosePool(const DataOptions& data, PoseUse use) {
  PosePool pool;
  if (data.t_pose) return pool;
  const HeldOutMotions held_out(data.exclude);
  for (const std::string& file : data.pose_databases) {
    addPoses(loadPoseDatabase(file), held_out, use, kThinning, pool);
  }
  if (data.procedural || data.pose_databases.empty()) {
    addPoses(proceduralMotions(data.seed), held_out, use, kThinning, pool);
  }
  return pool;
}

// Bodies, poses and the images made of them.
struct ImageSet {
  std::shared_ptr<const std::vector<BodySurface>> bodies;
  std::shared_ptr<const PosePool> poses;
  std::unique_ptr<RenderedImageSource> source;
};

ImageSet makeImageSet(const DataOptions& data, PoseUse use, std::size_t images) {
  const bool train = use == PoseUse::Train;
  const std::uint64_t seed = data.seed + (train ? 0 : kValidationSeed);
  ImageSet set;
  const BodyPoolOptions bodies{train ? data.bodies : std::max(1, data.bodies / 5), data.makehuman, seed};
  set.bodies = std::make_shared<const std::vector<BodySurface>>(makeBodyPool(bodies, data.threads));
  set.poses = std::make_shared<const PosePool>(makePosePool(data, use));
  RenderedImageOptions options;
  options.count = images;
  options.seed = seed;
  options.t_poses = data.t_pose;
  options.view.facing_share = 0.3;  // half of all views are then within 60 degrees of the camera
  set.source = std::make_unique<RenderedImageSource>(set.bodies, set.poses, options);
  return set;
}

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// ---- train ---------------------------------------------------------------------------------------------------------

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
  report.confusion = results[0];
  for (std::size_t i = 1; i < results.size(); ++i) points[i]->mean_accuracy = results[i].meanAccuracy();
}

// One tree each from ever fewer images.
void measureImageCurve(const TrainCommand& c, ImageSet& images, TrainingImageSource& validation,
                       TrainingReport& report) {
  for (const std::size_t part : {64U, 16U, 4U}) {
    RenderedImageOptions fewer = images.source->options();
    fewer.count = std::max<std::size_t>(1, c.images / part);
    RenderedImageSource source(images.bodies, images.poses, fewer);
    ForestTrainingOptions options = c.training;
    options.trees = 1;
    options.checkpoint.clear();
    options.resume = false;
    const auto trained = trainForest(source, options, [](const std::string&, double) {});
    const Forest forest = finishedForest(trained, c.finish, "");
    const auto result = measureAccuracy({&forest, 1}, validation, 2, c.data.threads, [](double) {});
    report.by_images.push_back({static_cast<double>(fewer.count), result[0].meanAccuracy()});
  }
  report.by_images.push_back({static_cast<double>(c.images), report.by_trees[0].mean_accuracy});
}

// What can be said before hours of work are done.
void prepareTraining(TrainCommand& c) {
  c.training.seed = c.data.seed;
  c.training.threads = c.data.threads;
  c.training.memory_bytes = static_cast<std::size_t>(c.memory_gb * 1e9);
  const fs::path out(c.out);
  if (out.has_parent_path() && !fs::is_directory(out.parent_path())) {
    throw Error("there is no such folder", out.parent_path().string(), "make it or choose another --out");
  }
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
  ImageSet images = makeImageSet(c.data, PoseUse::Train, c.images);
  ImageSet held_out = makeImageSet(c.data, PoseUse::Validate, c.validation_images);
  std::cerr << "data: " << images.source->description() << '\n';
  TrainingReport report;
  TrainingLog log;
  const auto trained = trainForest(*images.source, c.training, [&](const std::string& stage, double done) {
    if (stage == "rendering") report.render_s = secondsSince(start);
    log(stage, done);
  });
  report.training_s = secondsSince(start) - report.render_s;
  const Forest forest = finishedForest(trained, c.finish, images.source->description());
  saveForest(forest, c.out);
  const fs::path stem = fs::path(c.out).replace_extension();
  report.title = stem.filename().string();
  report.command = c.command_line;
  report.data = images.source->description();
  report.validation = held_out.source->description() + ", all held out";
  measureCurves(c, trained, forest, *held_out.source, report);
  if (c.image_curve) measureImageCurve(c, images, *held_out.source, report);
  writeTrainingReport(report, forest, fs::file_size(c.out), stem);
  std::cout << fmt::format("{}: mean accuracy {:.1f} % over the parts, {:.1f} % of the pixels\n", c.out,
                           100 * report.confusion.meanAccuracy(), 100 * report.confusion.accuracy());
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

void addTrain(CLI::App& forest) {
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

// ---- info ----------------------------------------------------------------------------------------------------------

void addInfo(CLI::App& forest) {
  auto file = std::make_shared<std::string>();
  CLI::App* command = forest.add_subcommand("info", "Says what is in a forest file");
  command->add_option("FILE", *file)->required();
  command->callback([file] {
    const Forest loaded = loadForest(*file);
    std::cout << fmt::format("{}: {} trees, {:.2f} MB\n{}\n", *file, loaded.trees.size(),
                             static_cast<double>(fs::file_size(*file)) / 1e6, loaded.origin);
    for (const ForestTree& tree : loaded.trees) {
      std::cout << fmt::format("  {} nodes, {} leaves, depth {}\n", tree.nodes.size(),
                               tree.leaves.size() / static_cast<std::size_t>(loaded.facings), treeDepth(tree));
    }
  });
}

// ---- evaluate ------------------------------------------------------------------------------------------------------

struct EvaluateCommand {
  DataOptions data;
  std::string file;
  std::string recording;
  std::string pictures;
  std::size_t images = 300;
  std::size_t step = 1;
};

void drawPictures(const Forest& forest, TrainingImageSource& source, const fs::path& folder) {
  fs::create_directories(folder);
  for (std::size_t i = 0; i < source.count(); ++i) {
    TrainingImage image;
    source.render(i, image);
    MaskImage mask(image.depth.width, image.depth.height, 0);
    for (std::size_t p = 0; p < mask.data.size(); ++p) mask.data[p] = image.depth.data[p] > 0.0F ? 1 : 0;
    ClassifiedPixels classified;
    classify(forest, image.depth, mask, image.focal_px, {}, classified);
    PartImage found;
    labelImage(classified, mask, found);
    // Truth to the left, what was found to the right.
    PartImage both(2 * found.width, found.height, 0);
    for (int y = 0; y < found.height; ++y) {
      for (int x = 0; x < found.width; ++x) {
        both.at(x, y) = image.labels.at(x, y);
        both.at(found.width + x, y) = found.at(x, y);
      }
    }
    writeColouredLabels(both, folder / fmt::format("{:06d}.png", i));
  }
}

void runEvaluate(const EvaluateCommand& c) {
  const Forest forest = loadForest(c.file);
  ImageSet rendered;
  std::unique_ptr<RecordedImageSource> recorded;
  TrainingImageSource* source = nullptr;
  if (c.recording.empty()) {
    rendered = makeImageSet(c.data, PoseUse::Validate, c.images);
    source = rendered.source.get();
  } else {
    recorded = std::make_unique<RecordedImageSource>(c.recording, c.step);
    source = recorded.get();
  }
  if (!c.pictures.empty()) drawPictures(forest, *source, c.pictures);
  if (recorded && !recorded->hasLabels()) {
    if (!c.pictures.empty()) return;
    throw Error("the recording has no true labels", c.recording,
                "make one with depthmocap synthesize, or ask for --pictures");
  }
  Progress bar("measuring", source->count());
  const auto confusion = measureAccuracy({&forest, 1}, *source, 1, c.data.threads, [&](double done) {
    bar.update(static_cast<std::size_t>(done * static_cast<double>(source->count())));
  })[0];
  std::cout << fmt::format("{}\nmean accuracy over the parts {:.1f} %, over the pixels {:.1f} % of {}\n",
                           source->description(), 100 * confusion.meanAccuracy(), 100 * confusion.accuracy(),
                           confusion.total());
  if (forest.facings > 1 && c.recording.empty()) {
    std::cout << fmt::format("the side that is seen found in {:.1f} % of the images\n",
                             100 * confusion.facingAccuracy());
  }
  for (int part = 0; part < kPartCount; ++part) {
    std::cout << fmt::format("  {:<16} {:5.1f} %\n", kPartNames[static_cast<std::size_t>(part) + 1],
                             100 * confusion.accuracyOf(part));
  }
}

void addEvaluate(CLI::App& forest) {
  auto c = std::make_shared<EvaluateCommand>();
  CLI::App* command =
      forest.add_subcommand("evaluate", "Measures a forest on held-out renders or a labelled recording");
  command->add_option("FILE", c->file, "Forest file")->required();
  command->add_option("--recording", c->recording,
                      "Recording with truth/labels to measure on; without them only for --pictures");
  command->add_option("--step", c->step, "Take every n-th frame of the recording")->capture_default_str();
  command->add_option("--images", c->images, "Rendered images to measure on")->capture_default_str();
  command->add_option("--pictures", c->pictures, "Folder for pictures: true parts left, found parts right");
  addDataOptions(*command, c->data);
  command->callback([c] { runEvaluate(*c); });
}

}  // namespace

void addForestCommand(CLI::App& app) {
  CLI::App* forest = app.add_subcommand("forest", "Trains, inspects and measures the classifier");
  forest->require_subcommand(1);
  addTrain(*forest);
  addInfo(*forest);
  addEvaluate(*forest);
}

}  // namespace depthmocap

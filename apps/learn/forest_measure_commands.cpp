#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/learn/forest_commands.h"
#include "apps/learn/forest_data.h"
#include "apps/terminal/output_check.h"
#include "apps/terminal/progress.h"
#include "depthmocap/error.h"
#include "forest/train/forest_accuracy.h"
#include "forest/train/joint_hits.h"
#include "forest/train/marker_statistics.h"
#include "forest/train/recorded_image_source.h"
#include "forest/train/training_report.h"
#include "forest/train/write_picture.h"
#include "libtracker/classify/classify.h"
#include "libtracker/classify/forest_file.h"
#include "libtracker/classify/label_image.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

struct EvaluateCommand {
  DataOptions data;
  std::string file;
  std::string recording;
  std::string references;
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
    writeComparison(image, found, folder / fmt::format("{:06d}.png", i));
  }
}

// The recordings in a folder that have a reference skeleton, in the order of their names.
std::vector<fs::path> recordingsWithReference(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (fs::exists(entry.path() / "reference" / "joints.csv")) found.push_back(entry.path());
  }
  if (found.empty())
    throw Error("no recording in it has a reference/joints.csv", folder.string(), "choose another folder");
  std::sort(found.begin(), found.end());
  return found;
}

void printJointHits(const Forest& forest, const EvaluateCommand& c) {
  const std::vector<fs::path> recordings = recordingsWithReference(c.references);
  Progress bar("measuring", recordings.size());
  std::vector<JointHits> of_recording(recordings.size());
  std::atomic<std::size_t> done = 0;
  parallelFor(c.data.threads, recordings.size(), [&](std::size_t i) {
    of_recording[i] = measureJointHits(forest, recordings[i], static_cast<int>(c.step));
    bar.update(++done);
  });
  JointHits hits;
  for (const JointHits& some : of_recording) hits.add(some);
  std::cout << fmt::format("{} frames of {} recordings, joints on a pixel of their parts: mean {:.1f} %\n",
                           hits.all[static_cast<std::size_t>(Joint::Head)], recordings.size(), 100 * hits.meanShare());
  for (std::size_t j = 0; j < kJointNames.size(); ++j) {
    if (hits.all[j] == 0) continue;
    std::cout << fmt::format("  {:<16} {:5.1f} %\n", kJointNames[j], 100 * hits.shareOf(static_cast<Joint>(j)));
  }
}

void runEvaluate(const EvaluateCommand& c) {
  OutputCheck check;
  readsData(check, c.data);
  check.reads(c.file);
  check.readsRecording(c.recording);
  check.writesFolder("--pictures", c.pictures);
  const Forest forest = loadForest(c.file);
  if (!c.references.empty()) {
    printJointHits(forest, c);
    return;
  }
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
  const auto accuracy = measureAccuracy({&forest, 1}, *source, 1, c.data.threads, [&](double done) {
    bar.update(static_cast<std::size_t>(done * static_cast<double>(source->count())));
  })[0];
  const ConfusionMatrix& confusion = accuracy.all;
  std::cout << fmt::format("{}\nmean accuracy over the parts {:.1f} %, over the pixels {:.1f} % of {}\n",
                           source->description(), 100 * confusion.meanAccuracy(), 100 * confusion.accuracy(),
                           confusion.total());
  if (forest.facings > 1 && c.recording.empty()) {
    const auto from = [&](Facing side) { return 100 * accuracy.from[static_cast<std::size_t>(side)].meanAccuracy(); };
    std::cout << fmt::format("seen from the front {:.1f} %, left {:.1f} %, back {:.1f} %, right {:.1f} %\n",
                             from(Facing::Front), from(Facing::Left), from(Facing::Back), from(Facing::Right));
    std::cout << fmt::format("the side found in {:.1f} % of the images; had it been told: {:.1f} %\n",
                             100 * accuracy.facingAccuracy(), 100 * accuracy.given_facing.meanAccuracy());
  }
  for (int part = 0; part < kPartCount; ++part) {
    std::cout << fmt::format("  {:<16} {:5.1f} %\n", kPartNames[static_cast<std::size_t>(part) + 1],
                             100 * confusion.accuracyOf(part));
  }
}

void printMarkers(const MarkerStatistics& statistics) {
  std::cout << "part               median [mm]   95 % [mm]   missing [%]   of\n";
  for (std::size_t part = 0; part < kPartCount; ++part) {
    const auto& p = statistics.parts[part];
    std::cout << fmt::format("  {:<16} {:>11.0f} {:>11.0f} {:>13.1f} {:>6}\n", kPartNames[part + 1], 1000 * p.median_m,
                             1000 * p.p95_m, 100.0 * p.missing / std::max(1, p.seen), p.seen);
  }
  std::cout << "confidence   markers   median [mm]   nearer than 5 cm [%]\n";
  for (int bin = 0; bin < MarkerStatistics::kConfidenceBins; ++bin) {
    const auto& b = statistics.by_confidence[static_cast<std::size_t>(bin)];
    std::cout << fmt::format("  {:.1f} - {:.1f} {:>10} {:>13.0f} {:>22.1f}\n", 0.1 * bin, 0.1 * (bin + 1), b.count,
                             1000 * b.median_m, 100 * b.within);
  }
}

}  // namespace

void addForestInfo(CLI::App& forest) {
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

void addForestEvaluate(CLI::App& forest) {
  auto c = std::make_shared<EvaluateCommand>();
  CLI::App* command =
      forest.add_subcommand("evaluate", "Measures a forest on held-out renders or a labelled recording");
  command->add_option("FILE", c->file, "Forest file")->required();
  command->add_option("--recording", c->recording,
                      "Recording with truth/labels to measure on; without them only for --pictures");
  command
      ->add_option("--reference", c->references,
                   "Folder of recordings without background: how many joints of their reference/joints.csv lie on "
                   "their parts")
      ->check(CLI::ExistingDirectory);
  command->add_option("--step", c->step, "Take every n-th frame of the recording")->capture_default_str();
  command->add_option("--images", c->images, "Rendered images to measure on")->capture_default_str();
  command->add_option("--pictures", c->pictures, "Folder for pictures: depth, true labels, found labels");
  addDataOptions(*command, c->data);
  command->callback([c] { runEvaluate(*c); });
}

void addForestMarkers(CLI::App& forest) {
  struct Options {
    DataOptions data;
    std::string file;
    int images = 500;
  };
  auto c = std::make_shared<Options>();
  CLI::App* command =
      forest.add_subcommand("markers", "Measures how far markers lie from where they should, on held-out renders");
  command->add_option("FILE", c->file, "Forest file")->required();
  command->add_option("--images", c->images, "Rendered images to measure on")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  addDataOptions(*command, c->data);
  command->callback([c] {
    const Forest forest_file = loadForest(c->file);
    const ImageSet set = makeImageSet(c->data, PoseUse::Validate, 1);
    MarkerStatisticsConfig config;
    config.images = c->images;
    config.seed = c->data.seed;
    config.threads = c->data.threads;
    config.view = set.view;
    printMarkers(measureMarkers(*set.bodies, set.poses->poses, &forest_file, config));
  });
}

}  // namespace depthmocap

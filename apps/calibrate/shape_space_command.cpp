#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/terminal/motion_options.h"
#include "apps/terminal/output_check.h"
#include "calibration/shape_space.h"
#include "depthmocap/error.h"
#include "libtracker/motion/motion_files.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

struct ShapeSpaceOptions {
  fs::path motions;
  fs::path out;
  double share = 0.99;
  LoadOptions load;
};

// One motion a skeleton: the performer's bone lengths do not depend on which.
std::vector<fs::path> oneMotionPerSkeleton(const fs::path& folder, const LoadOptions& load) {
  std::vector<fs::path> chosen;
  fs::path last;
  for (const fs::path& motion : findMotionFiles(folder)) {
    if (motion.extension() != ".amc") continue;
    const fs::path asf = load.asf ? *load.asf : asfFor(motion);
    if (asf == last) continue;
    last = asf;
    chosen.push_back(motion);
  }
  return chosen;
}

void build(const ShapeSpaceOptions& o) {
  OutputCheck check;
  readsMotions(check, o.motions, o.load);
  check.writes("--out", o.out);
  std::vector<BoneLengths> measured;
  for (const fs::path& motion : oneMotionPerSkeleton(o.motions, o.load)) {
    const RetargetResult result = retargetMotionFile(motion, o.load);
    printMotionWarnings(motion, result.warnings);
    measured.push_back(result.clip.lengths);
  }
  if (measured.size() < 2) throw Error("fewer than two ASF skeletons with motions", o.motions.string());
  const ShapeSpace space = makeShapeSpace(
      measured, o.share,
      fmt::format("proportions of {} measured skeletons about the family of built-in bodies", measured.size()));
  saveShapeSpace(o.out, space);
  std::cerr << fmt::format("{} skeletons, {} components\n", measured.size(), space.deviation.size());
}

}  // namespace

void addShapeSpaceCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("shape-space", "Makes the statistics of bone lengths that calibrate uses.");
  const auto options = std::make_shared<ShapeSpaceOptions>();
  command->add_option("--motions", options->motions, "Folder with ASF and AMC files")->type_name("DIR")->required();
  command->add_option("--out", options->out, "File to write, JSON")->required();
  command->add_option("--share", options->share, "Share of the variance that the components hold")
      ->check(CLI::Range(0.5, 1.0))
      ->capture_default_str();
  addMotionOptions(*command, options->load);
  command->callback([options] { build(*options); });
}

}  // namespace depthmocap

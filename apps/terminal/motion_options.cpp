#include "apps/terminal/motion_options.h"

#include <CLI/CLI.hpp>
#include <map>

#include "apps/terminal/warnings.h"
#include "depthmocap/error.h"
#include "libtracker/motion/text_scanner.h"

namespace depthmocap {
namespace {

// Metres per unit of a name, or of a number.
double unitOf(const std::string& text) {
  static const std::map<std::string, double> kNamed = {{"m", 1.0},    {"dm", 0.1},    {"cm", 0.01},
                                                       {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  if (const auto found = kNamed.find(text); found != kNamed.end()) return found->second;
  double value = 0;
  if (!CLI::detail::lexical_cast(text, value) || !(value > 0 && value < 1e3)) {
    throw CLI::ValidationError("--unit", "must be m, dm, cm, mm, in, ft or how many metres one unit is, not " + text);
  }
  return value;
}

}  // namespace

void addMotionOptions(CLI::App& command, LoadOptions& options) {
  constexpr double kMinFps = 1.0;
  constexpr double kMaxFps = 1000.0;
  command
      .add_option_function<std::string>(
          "--asf", [&options](const std::string& file) { options.asf = file; },
          "Skeleton of the AMC files (default: <subject>.asf beside each, or the only ASF of its folder)")
      ->type_name("FILE");
  command
      .add_option_function<std::string>(
          "--unit", [&options](const std::string& text) { options.bvh_metres_per_unit = unitOf(text); },
          "Unit of length of the BVH files: m, dm, cm, mm, in, ft or metres (default: by the body's size)")
      ->type_name("UNIT");
  command
      .add_option_function<std::string>(
          "--bones", [&options](const std::string& file) { options.bones = readBoneMap(file); },
          "Which bones are which, where names do not say it: {\"head\": \"bone 7\", \"left_upper_arm\": ...}")
      ->type_name("MAP.json");
  command
      .add_option("--fps", options.fps_if_unsaid, "Frame rate of files that hold none (AMC) or an impossible one [1/s]")
      ->check(CLI::Range(kMinFps, kMaxFps))
      ->capture_default_str();
}

void readsMotions(OutputCheck& check, const std::filesystem::path& motions, const LoadOptions& load) {
  std::vector<std::filesystem::path> files = {motions};
  if (std::filesystem::is_directory(motions)) files = findMotionFiles(motions);
  if (load.asf) check.reads(*load.asf);
  for (const std::filesystem::path& file : files) {
    check.reads(file);
    if (load.asf || lowerCase(file.extension().string()) != ".amc") continue;
    try {
      check.reads(asfFor(file));
    } catch (const Error&) {  // NOLINT(bugprone-empty-catch): reading it will say so
    }
  }
}

void printMotionWarnings(const std::filesystem::path& file, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) {
    warn(file.string() + ": " + warning);
  }
}

}  // namespace depthmocap

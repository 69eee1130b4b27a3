#include "libtracker/motion/motion_files.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/motion/asf_amc.h"
#include "libtracker/motion/bone_roles.h"
#include "libtracker/motion/bvh.h"
#include "libtracker/motion/text_scanner.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

std::string extensionOf(const fs::path& path) {
  return lowerCase(path.extension().string());
}

void requirePositive(double value, const char* field) {
  if (!(value > 0) || !std::isfinite(value)) throw Error(fmt::format("{} must be positive", value), field);
}

// The longest way [m] that a joint goes from one frame to the next.
double longestStep(const SourceMotion& motion, std::size_t frame, double metres_per_unit) {
  GlobalFrame a;
  GlobalFrame b;
  globalFrame(motion.bones, motion.frames[frame], a);
  globalFrame(motion.bones, motion.frames[frame + 1], b);
  double longest = 0;
  for (std::size_t i = 0; i < a.position.size(); ++i)
    longest = std::max(longest, (b.position[i] - a.position[i]).norm());
  return longest * metres_per_unit;
}

void repairFirstFrame(SourceMotion& motion, double metres_per_unit) {
  constexpr double kJump = 0.35;        // [m] more than 10 m/s at 30 frames a second
  constexpr double kTimesSecond = 4.0;  // and far more than the next step
  constexpr double kSlowestRate = 20.0;
  if (motion.frames.size() < 3 || motion.fps < kSlowestRate) return;
  const double first = longestStep(motion, 0, metres_per_unit);
  if (first > kJump && first > kTimesSecond * longestStep(motion, 1, metres_per_unit))
    motion.frames[0] = motion.frames[1];
}

}  // namespace

void LoadOptions::validate() const {
  requirePositive(amc_fps, "amc_fps");
  requirePositive(max_fps, "max_fps");
  if (bvh_metres_per_unit) requirePositive(*bvh_metres_per_unit, "bvh_metres_per_unit");
}

fs::path asfFor(const fs::path& amc) {
  const std::string stem = amc.stem().string();
  for (const std::string& name : {stem.substr(0, stem.rfind('_')), stem}) {
    for (const char* extension : {".asf", ".ASF"}) {
      fs::path candidate = amc.parent_path() / (name + extension);
      if (fs::is_regular_file(candidate)) return candidate;
    }
  }
  throw Error("there is no ASF file for this motion beside it", amc.string(), "name the skeleton's ASF file");
}

RetargetResult retargetMotionFile(const fs::path& path, const LoadOptions& options) {
  options.validate();
  const std::string extension = extensionOf(path);
  SourceMotion motion;
  double metres_per_unit = 1.0;
  if (extension == ".amc") {
    motion = readAmc(path, readAsf(options.asf ? *options.asf : asfFor(path)), options.amc_fps);
  } else if (extension == ".bvh") {
    motion = readBvh(path);
    const GlobalFrame rest = restFrame(motion.bones);
    metres_per_unit = options.bvh_metres_per_unit
                          ? *options.bvh_metres_per_unit
                          : detectMetresPerUnit(rest, findBoneRoles(motion.bones, path.string()), path.string());
  } else {
    throw Error("this is neither an .amc nor a .bvh file", path.string());
  }
  if (options.repair_first_frame) repairFirstFrame(motion, metres_per_unit);
  // A rate that differs only by the digits of its file (0.0333333 s) needs no new frames.
  constexpr double kSameRate = 1.001;
  if (motion.fps > options.max_fps * kSameRate) motion = resampled(motion, options.max_fps);
  RetargetResult result = retarget(motion, metres_per_unit, path.string());
  result.clip.name = path.stem().string();
  return result;
}

MotionClip loadMotion(const fs::path& path, const LoadOptions& options) {
  return retargetMotionFile(path, options).clip;
}

std::vector<fs::path> findMotionFiles(const fs::path& folder) {
  std::error_code failure;
  if (!fs::is_directory(folder, failure)) throw Error("this is not a folder", folder.string());
  std::vector<fs::path> files;
  std::set<fs::path> visited = {fs::canonical(folder)};  // links may lead in a circle
  const auto options = fs::directory_options::skip_permission_denied | fs::directory_options::follow_directory_symlink;
  for (auto entry = fs::recursive_directory_iterator(folder, options); entry != fs::recursive_directory_iterator();
       ++entry) {
    if (entry->is_directory(failure)) {
      if (!visited.insert(fs::canonical(entry->path())).second) entry.disable_recursion_pending();
      continue;
    }
    const std::string extension = extensionOf(entry->path());
    if (entry->is_regular_file(failure) && (extension == ".amc" || extension == ".bvh")) files.push_back(entry->path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace depthmocap

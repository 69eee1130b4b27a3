#include "libtracker/motion/motion_files.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/motion/asf_amc.h"
#include "libtracker/motion/bone_roles.h"
#include "libtracker/motion/bvh.h"
#include "libtracker/motion/mirrored_sides.h"
#include "libtracker/motion/standing_rest.h"
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
  requirePositive(fps_if_unsaid, "fps_if_unsaid");
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
  std::vector<fs::path> skeletons;
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(amc.has_parent_path() ? amc.parent_path() : ".", failure)) {
    if (extensionOf(entry.path()) == ".asf") skeletons.push_back(entry.path());
  }
  if (skeletons.size() == 1) return skeletons[0];
  throw Error("there is no ASF file for this motion beside it", amc.string(), "--asf names the skeleton's file");
}

namespace {

SourceMotion readMotionFile(const fs::path& path, const LoadOptions& options) {
  const std::string extension = extensionOf(path);
  if (extension == ".amc") {
    return readAmc(path, readAsf(options.asf ? *options.asf : asfFor(path)), options.fps_if_unsaid);
  }
  if (extension == ".bvh") return readBvh(path, options.fps_if_unsaid);
  throw Error("this is neither an .amc nor a .bvh file", path.string());
}

// An AMC's lengths are in metres; a BVH says nothing.
double metresPerUnit(SourceMotion& motion, const NamedBones& named, const fs::path& path, const LoadOptions& options) {
  if (extensionOf(path) == ".amc") return 1.0;
  if (options.bvh_metres_per_unit) return *options.bvh_metres_per_unit;
  const std::vector<MotionBone> bones = meanBones(motion);
  const double unit = detectMetresPerUnit(restFrame(bones), findBoneRoles(bones, named, path.string()), path.string());
  constexpr std::array<std::pair<double, const char*>, 2> kRare = {{{0.3048, "feet"}, {0.1, "decimetres"}}};
  for (const auto& [value, name] : kRare) {
    if (unit == value) motion.warnings.push_back(fmt::format("the body's size says that lengths are {}", name));
  }
  return unit;
}

// Where the body does not follow the file.
void addFitWarnings(RetargetResult& result) {
  constexpr double kLargeResidual_m = 0.02;
  constexpr double kManyFrames = 0.3;  // CMU's motions are below
  constexpr double kMillimetres = 1000.0;
  constexpr double kPercent = 100.0;
  const double mean = result.residuals.mean();
  if (mean > kLargeResidual_m) {
    result.warnings.push_back(
        fmt::format("joints are {:.0f} mm off the file's on average: is it read rightly?", kMillimetres * mean));
  }
  if (result.beyond_limits > kManyFrames) {
    result.warnings.push_back(fmt::format("{:.0f} % of the frames are beyond the joint limits: is it read rightly?",
                                          kPercent * result.beyond_limits));
  }
}

}  // namespace

RetargetResult retargetMotionFile(const fs::path& path, const LoadOptions& options) {
  options.validate();
  SourceMotion motion = readMotionFile(path, options);
  NamedBones named = namedBones(motion.bones, options.bones, path.string());
  findBoneRoles(meanBones(motion), named, path.string());  // Error where a part is missing
  if (sidesAreMirrored(motion, named)) {
    std::swap(named.left, named.right);
    motion.warnings.push_back("knees and toes point backwards, as in a mirrored file: left is taken for right");
  }
  motion = withStandingRest(std::move(motion), named);
  const double metres_per_unit = metresPerUnit(motion, named, path, options);
  if (options.repair_first_frame) repairFirstFrame(motion, metres_per_unit);
  // A rate that differs only by the digits of its file (0.0333333 s) needs no new frames.
  constexpr double kSameRate = 1.001;
  if (motion.fps > options.max_fps * kSameRate) motion = resampled(motion, options.max_fps);
  RetargetResult result = retarget(motion, named, metres_per_unit, path.string());
  result.clip.name = path.stem().string();
  addFitWarnings(result);
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

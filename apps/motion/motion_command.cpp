#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/terminal/motion_options.h"
#include "apps/terminal/output_check.h"
#include "libtracker/motion/motion_files.h"
#include "libtracker/recording/track_files.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

struct MotionOptions {
  fs::path file;
  fs::path joints;
  LoadOptions load;
};

// The joints as a level camera at the world's origin would see them, so that `evaluate` can compare two files.
void writeJoints(const MotionClip& clip, const fs::path& path) {
  const Skeleton skeleton = makeSkeleton(clip.lengths);
  const Eigen::Matrix3d R_camera_world = uprightWorldFromCamera().transpose();
  JointsWriter writer(path);
  for (std::size_t f = 0; f < clip.poses.size(); ++f) {
    JointsRow row;
    row.frame = static_cast<std::int64_t>(f);
    row.time_s = static_cast<double>(f) / clip.fps;
    row.state = TrackState::Tracking;
    row.p_camera = R_camera_world * jointPositions(skeleton, clip.poses[f]);
    row.confidence.setOnes();
    writer.write(row);
  }
  writer.finish();
}

void show(const MotionOptions& o) {
  OutputCheck check;
  readsMotions(check, o.file, o.load);
  check.writes("--joints", o.joints);
  const RetargetResult result = retargetMotionFile(o.file, o.load);
  printMotionWarnings(o.file, result.warnings);
  if (!o.joints.empty()) writeJoints(result.clip, o.joints);
  constexpr double kMillimetres = 1000.0;
  constexpr double kPercent = 100.0;
  const BoneLengths& l = result.clip.lengths;
  fmt::print("frames       {}, {:.4g} per second\n", result.clip.poses.size(), result.clip.fps);
  fmt::print("bones        upper leg {:.3f}, lower leg {:.3f}, torso {:.3f}, upper arm {:.3f}, lower arm {:.3f} m\n",
             l.upper_leg, l.lower_leg, l.torso, l.upper_arm, l.lower_arm);
  fmt::print("residual     {:.1f} mm mean over joints and frames\n", kMillimetres * result.residuals.mean());
  fmt::print("limits       {:.0f} % of the frames beyond the joint limits\n", kPercent * result.beyond_limits);
}

}  // namespace

void addMotionCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("motion", "Reads a motion file and says what was understood of it.");
  const auto options = std::make_shared<MotionOptions>();
  command->add_option("FILE", options->file, "AMC or BVH file")->required();
  command->add_option("--joints", options->joints, "Joints file of the retargeted motion, for `evaluate`")
      ->type_name("J.csv");
  addMotionOptions(*command, options->load);
  command->callback([options] { show(*options); });
}

}  // namespace depthmocap

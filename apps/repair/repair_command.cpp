#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/commands.h"
#include "apps/repair/evaluate.h"
#include "apps/terminal/output_check.h"
#include "depthmocap/error.h"
#include "libtracker/core/csv.h"
#include "libtracker/core/shipped_files.h"
#include "libtracker/marker_files/marker_files.h"
#include "libtracker/motion/bvh_writer.h"
#include "libtracker/recording/track_files.h"
#include "libtracker/repair/repair.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

// The names of --up, in the order of UpAxis.
const std::vector<std::string> kUpNames = {"x", "-x", "y", "-y", "z", "-z"};

struct RepairOptions {
  fs::path markers;
  fs::path out;
  fs::path poses;
  fs::path bvh;
  fs::path names;
  fs::path priors;
  std::string up;
  double noise_mm = -1;  // below 0: measured
  int threads = 2;
};

// Gives markers the names of a file `marker,name`.
void rename(const fs::path& path, MarkerSequence& markers) {
  CsvReader csv(path);
  csv.readHeader({"marker", "name"});
  while (csv.next()) {
    const auto found = std::find_if(markers.tracks.begin(), markers.tracks.end(),
                                    [&](const MarkerTrack& track) { return track.name == csv.field(0); });
    if (found == markers.tracks.end()) csv.fail(fmt::format("there is no marker '{}'", csv.field(0)));
    if (!siteNamed(csv.field(1))) csv.fail(fmt::format("'{}' is no joint or marker that is known", csv.field(1)));
    found->name = std::string(csv.field(1));
  }
}

// Joints of every frame in the file's frame: those that are markers, and of the fitted body where there is none.
void writeJoints(const MarkerSequence& input, const RepairResult& result, const fs::path& path) {
  JointsWriter writer(path);
  for (std::size_t t = 0; t < input.frames(); ++t) {
    const auto column = static_cast<Eigen::Index>(t);
    JointsRow row;
    row.frame = input.frame[t];
    row.time_s = input.time_s[t];
    row.p_camera = result.R_world_file.transpose() * jointPositions(result.body.skeleton, result.poses[t]);
    bool any_seen = false;
    for (const MarkerTrack& track : input.tracks) any_seen = any_seen || track.seen[column];
    for (int joint = 0; joint < kJointCount; ++joint) {
      const std::string_view name = kJointNames[static_cast<std::size_t>(joint)];
      const MarkerTrack* const repaired = result.markers.find(name);
      if (repaired == nullptr || !repaired->seen[column]) continue;
      row.p_camera.col(joint) = repaired->p.col(column);
      row.confidence[joint] = input.find(name)->seen[column] ? 1.0 : 0.0;
    }
    row.state = any_seen ? TrackState::Tracking : TrackState::Coasting;
    writer.write(row);
  }
  writer.finish();
}

void writePoses(const RepairResult& result, const fs::path& path) {
  PoseWriter writer(path);
  for (std::size_t t = 0; t < result.poses.size(); ++t) {
    writer.write({result.markers.frame[t], result.markers.time_s[t], result.poses[t], result.R_world_file});
  }
  writer.finish();
}

void writeMotion(const RepairResult& result, const fs::path& path) {
  BvhWriter writer(path, result.body.skeleton, result.markers.fps);
  for (const Pose& q : result.poses) writer.write(q);
  writer.finish();
}

void report(const MarkerSequence& input, const RepairResult& result) {
  Eigen::Index filled = 0;
  for (const MarkerTrack& track : input.tracks) filled += track.seen.size() - track.seen.count();
  std::cerr << fmt::format(
      "{} markers, {} frames: {} samples filled, {} taken for wrong, noise {:.1f} mm; body {:.2f} m\n",
      input.tracks.size(), input.frames(), filled, result.outliers, 1000.0 * result.noise_m,
      statureOf(result.body.skeleton.lengths));
  if (result.loose.empty()) return;
  std::cerr << fmt::format("on no bone, so only their gaps were closed: {}\n", fmt::join(result.loose, " "));
}

RepairConfig configOf(const RepairOptions& o) {
  RepairConfig config;
  config.usual_up = usualUpAxis(markerFileKind(o.markers));
  if (!o.up.empty()) {
    config.up = static_cast<UpAxis>(std::find(kUpNames.begin(), kUpNames.end(), o.up) - kUpNames.begin());
  }
  if (o.noise_mm >= 0) config.noise_m = 0.001 * o.noise_mm;
  config.sequence.threads = o.threads;
  return config;
}

void repairFile(const RepairOptions& o) {
  if (o.markers.empty()) throw CLI::RequiredError("MARKERS");
  if (o.out.empty()) throw CLI::RequiredError("--out");
  const MarkerFileKind out_kind = markerFileKind(o.out);
  OutputCheck check;
  for (const fs::path& input : {o.markers, o.names, o.priors}) check.reads(input);
  check.writes("--out", o.out);
  check.writes("--poses", o.poses);
  check.writes("--bvh", o.bvh);
  MarkerSequence markers = readMarkers(o.markers);
  if (!o.names.empty()) rename(o.names, markers);
  const auto learned = std::make_shared<const LearnedPoses>(
      loadLearnedPoses(o.priors.empty() ? shippedFile("pose_priors.bin") : o.priors));
  const RepairResult result = [&] {
    try {
      return repair(markers, learned, configOf(o));
    } catch (const Error& error) {
      throw Error(error.what(), o.markers.string());
    }
  }();
  if (out_kind == MarkerFileKind::JointsCsv) writeJoints(markers, result, o.out);
  if (out_kind == MarkerFileKind::Trc) writeTrc(result.markers, o.out);
  if (out_kind == MarkerFileKind::C3d) writeC3d(result.markers, o.out);
  if (!o.poses.empty()) writePoses(result, o.poses);
  if (!o.bvh.empty()) writeMotion(result, o.bvh);
  report(markers, result);
}

}  // namespace

void addRepairCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("repair", "Fills gaps and removes noise of markers or joints over time.");
  const auto o = std::make_shared<RepairOptions>();
  command->add_option("markers", o->markers, "Joints file (.csv), .trc or .c3d")->type_name("MARKERS");
  command->add_option("--out", o->out, "The repaired markers, .csv (joints), .trc or .c3d")->type_name("OUT");
  command->add_option("--poses", o->poses, "Poses to write, CSV: 36 degrees of freedom a frame")->type_name("P.csv");
  command->add_option("--bvh", o->bvh, "Motion to write, BVH in metres")->type_name("M.bvh");
  command
      ->add_option("--names", o->names,
                   "CSV marker,name: where markers are whose own names do not say so (left_wrist, LWRA, ...)")
      ->type_name("N.csv");
  command->add_option("--up", o->up, "Axis that points up (default: where heads are above feet)")
      ->check(CLI::IsMember(kUpNames));
  command
      ->add_option("--noise", o->noise_mm,
                   "Deviation of the noise of each coordinate [mm] (default: measured, marker by marker)")
      ->check(CLI::Range(0.0, 500.0));
  command->add_option("--priors", o->priors, "Learned poses (see posedb learn-priors; default: those of the build)")
      ->type_name("FILE");
  command->add_option("--threads", o->threads, "Threads; the result does not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->footer("Example:\n  depthmocap repair take.c3d --out repaired.c3d --bvh take.bvh");
  addRepairEvaluateCommand(*command);
  command->callback([o, command] {
    if (command->get_subcommands().empty()) repairFile(*o);
  });
}

}  // namespace depthmocap

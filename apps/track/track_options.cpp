#include "apps/track/track_options.h"

#include <CLI/CLI.hpp>

#include "apps/view/view_options.h"
#include "libtracker/motion/rig.h"
#include "libtracker/segment/segment.h"
#include "libtracker/tracker/leave_out.h"

namespace depthmocap {
namespace {

// Headings of --help; the first is CLI11's own for options of no other.
constexpr const char* kEveryday = "Options";
constexpr const char* kOutputs = "Outputs";
constexpr const char* kResearch = "Parts and parameters of the tracker, for research";

void addAnimationOptions(CLI::App& command, TrackOptions& o) {
  command.add_option("--usd", o.usd, "The same as UsdSkel, USD as text")->type_name("M.usda");
  command
      .add_option("--rig", o.rig,
                  "Names of bones and rest pose of BVH, glTF and USD as a program's own characters have them")
      ->check(CLI::IsMember(std::vector<std::string>(kRigNames.begin(), kRigNames.end())))
      ->capture_default_str();
  command
      .add_option_function<std::string>(
          "--root-motion", [&o](const std::string& kind) { o.in_place = kind == "in-place"; },
          "Whether the hips of BVH, glTF and USD travel (full) or stay above the origin (in-place)")
      ->check(CLI::IsMember({"full", "in-place"}))
      ->default_str("full");
  command.add_option("--fps-out", o.fps_out, "Frames per second of BVH, glTF and USD (default: as tracked)")
      ->check(CLI::Range(1.0, 1000.0));
  command.add_flag("--loop", o.loop, "The end of BVH, glTF and USD meets their start");
  command
      .add_option_function<std::string>(
          "--fbx", [](const std::string&) {}, "Not written: see docs/guide/animation.md for the way through Blender")
      ->check([](const std::string&) {
        return std::string("is not written; write --gltf M.glb, import it in Blender and export FBX there");
      })
      ->type_name("M.fbx");
}

}  // namespace

bool asksForNothing(const TrackOptions& o) {
  const bool any_motion = !(o.joints.empty() && o.pose.empty() && o.angles.empty() && o.bvh.empty() && o.gltf.empty() &&
                            o.usd.empty() && o.trc.empty() && o.c3d.empty() && o.mot.empty());
  const bool any_file = any_motion || !(o.labels.empty() && o.preview.empty() && o.contact_sheet.empty() &&
                                        o.stats.empty() && o.save_config.empty());
  return !any_file && o.vmc.empty() && o.osc_trackers.empty() && !o.view.on;
}

void addTrackOptions(CLI::App& command, TrackOptions& o) {
  command.add_option("--people", o.people, "Most people that are tracked at the same time")
      ->check(CLI::Range(1, kMostPeople))
      ->type_name("N")
      ->capture_default_str();
  command
      .add_option("--actor", o.actor,
                  "Calibrated body (see calibrate); otherwise the size is fitted while tracking; of several people the "
                  "first one")
      ->type_name("A.json");
  command.option_defaults()->group(kOutputs);
  command.add_option("--joints", o.joints, "Joint centres in the camera frame, CSV")->type_name("J.csv");
  command.add_option("--pose", o.pose, "The 36 degrees of freedom per frame, CSV")->type_name("Q.csv");
  command
      .add_option(
          "--angles", o.angles,
          "Clinical angles in degrees: flexion, abduction, rotation of each joint, CSV (docs/reference/angles.md)")
      ->type_name("A.csv");
  command.add_option("--trc", o.trc, "Joint centres as markers for OpenSim, TRC, mm, y up")->type_name("M.trc");
  command.add_option("--c3d", o.c3d, "Joint centres as markers for laboratories, C3D, mm, z up")->type_name("M.c3d");
  command.add_option("--mot", o.mot, "Coordinates of OpenSim's model Rajagopal2016, degrees and metres")
      ->type_name("M.mot");
  command.add_option("--bvh", o.bvh, "Motion for animation programs, BVH, y up")->type_name("M.bvh");
  command.add_option("--bvh-unit", o.bvh_unit, "Unit of length of the BVH: m or cm")
      ->check(CLI::IsMember({"m", "cm"}))
      ->capture_default_str();
  command.add_flag("--bvh-moving", o.bvh_moving,
                   "Bones of the BVH follow the size as it is found, by position channels; not for three.js");
  command.add_option("--gltf", o.gltf, "Skeleton, body surface and motion, binary glTF")->type_name("M.glb");
  addAnimationOptions(command, o);
  command
      .add_option("--origin", o.origin,
                  "Origin of BVH, glTF, USD, TRC, C3D and .mot: floor, below the hips of the first frame, so that feet "
                  "stand at "
                  "height 0; or the camera")
      ->check(CLI::IsMember({"floor", "camera"}))
      ->capture_default_str();
  command.add_option("--vmc", o.vmc, "Streams the motion by the VMC protocol (VSeeFace, Unity, Unreal)")
      ->type_name("HOST:PORT");
  command
      .add_option("--osc-trackers", o.osc_trackers,
                  "Streams hips, chest, feet, knees, elbows and head as VR trackers to VRChat (its port is 9000)")
      ->type_name("HOST:PORT");
  command.option_defaults()->group(kEveryday);
  command.add_option("--smooth", o.smooth, "Calms all outputs (One-Euro filter): 0 = off, 1 = most")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  command.option_defaults()->group(kOutputs);
  command.add_option("--labels", o.labels, "Folder for one body-part label image per frame, PNG")->type_name("DIR");
  command.add_option("--preview", o.preview, "Film of the tracking beside a view from the side, MP4")
      ->type_name("V.mp4");
  command.add_option("--contact-sheet", o.contact_sheet, "Up to 12 preview pictures of the run on one sheet, PNG")
      ->type_name("SHEET.png");
  command.add_option("--stats", o.stats, "Counts and times of each stage, JSON")->type_name("S.json");
  command.option_defaults()->group("Page in a browser");
  addViewOptions(command, o.view);
  command.option_defaults()->group(kResearch);
  command.add_option("--forest", o.forest, "Body-part classifier (default: the one that comes with the build)");
  command.add_option("--posedb", o.posedb, "Pose database (default: the one that comes with the build)");
  command
      .add_option("--method", o.method,
                  "full: with the dense term and measured weights; paper: as Su, Chai, Xia 2016 give it")
      ->check(CLI::IsMember({"full", "paper"}))
      ->capture_default_str();
  command
      .add_option(
          "--without", o.without,
          "Parts of the method to leave out, to measure what each is worth; weights: the paper's instead of ours")
      ->delimiter(',')
      ->check(CLI::IsMember(optionalParts()))
      ->type_name("PART,...");
  command.add_option("--config", o.config, "Parameters of the tracker, JSON (docs/reference/config.md), over --method")
      ->type_name("C.json");
  command.add_option("--save-config", o.save_config, "Write the parameters in use, JSON")->type_name("C.json");
  command.option_defaults()->group(kEveryday);
  command.add_option("--stature", o.assumed_stature_m, "Stature to start from without --actor [m]")
      ->check(CLI::Range(1.0, 2.2));
  command.add_option("--threads", o.threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
}

void checkTrackOptions(OutputCheck& check, const TrackOptions& o) {
  for (const auto& input : {o.actor, o.forest, o.posedb, o.config}) check.reads(input);
  check.writes("--joints", o.joints);
  check.writes("--pose", o.pose);
  check.writes("--bvh", o.bvh);
  check.writes("--gltf", o.gltf);
  check.writes("--usd", o.usd);
  check.writes("--angles", o.angles);
  check.writes("--trc", o.trc);
  check.writes("--c3d", o.c3d);
  check.writes("--mot", o.mot);
  check.writesFolder("--labels", o.labels);
  check.writes("--preview", o.preview);
  check.writes("--contact-sheet", o.contact_sheet);
  check.writes("--stats", o.stats);
  check.writes("--save-config", o.save_config);
}

void addLookAheadOption(CLI::App& command, double& seconds) {
  command
      .add_option("--look-ahead", seconds,
                  "Each pose explains the frames up to so many seconds before and after it, too; 0 = off, as live is")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
}

}  // namespace depthmocap

#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "apps/terminal/output_check.h"
#include "apps/view/view_options.h"

namespace CLI {
class App;
}

namespace depthmocap {

// Options that every tracking command shares; empty = not asked for.
struct TrackOptions {
  int people = 1;               // tracked at the same time
  std::filesystem::path actor;  // a calibrated body
  std::filesystem::path forest;
  std::filesystem::path posedb;
  std::filesystem::path joints;
  std::filesystem::path pose;
  std::filesystem::path bvh;
  std::string origin = "floor";  // of files for animation and laboratories, or "camera"
  bool bvh_moving = false;       // position channels for all bones of the BVH where the body's size was being found
  std::string bvh_unit = "m";    // or "cm"
  std::filesystem::path gltf;
  std::filesystem::path usd;
  std::string rig = "motionbuilder";  // names of bones and rest pose in BVH, glTF and USD
  bool in_place = false;              // the hips of BVH, glTF and USD stay above the origin
  double fps_out = 0;                 // [1/s] of BVH, glTF and USD; 0 = as tracked
  bool loop = false;                  // their end meets their start
  std::filesystem::path angles;
  std::filesystem::path trc;
  std::filesystem::path c3d;
  std::filesystem::path mot;
  std::string vmc;           // HOST:PORT
  std::string osc_trackers;  // HOST:PORT
  ViewOptions view;
  double smooth = 0;  // [0, 1] of the output filter; 0 = off
  std::filesystem::path labels;
  std::filesystem::path preview;
  std::filesystem::path contact_sheet;
  std::filesystem::path stats;
  std::filesystem::path config;       // of the tracker, read
  std::filesystem::path save_config;  // of the tracker, written
  int threads = 2;
  std::string method = "full";
  std::vector<std::string> without;  // parts of the method, see leaveOut()
  double assumed_stature_m = 0;      // [m] 0 = the tracker's default
};

void addTrackOptions(CLI::App& command, TrackOptions& options);

// Whether a run would leave nothing behind: no file, no stream, no page.
bool asksForNothing(const TrackOptions& options);

// --look-ahead; `seconds` keeps its value unless it is given.
// Adds what the options read and write. Error as OutputCheck.
void checkTrackOptions(OutputCheck& check, const TrackOptions& options);

void addLookAheadOption(CLI::App& command, double& seconds);

}  // namespace depthmocap

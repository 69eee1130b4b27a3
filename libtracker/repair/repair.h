#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "libtracker/ik/learned_poses.h"
#include "libtracker/ik/pose_sequence.h"
#include "libtracker/marker_files/marker_sequence.h"
#include "libtracker/repair/marker_body.h"

namespace depthmocap {

struct RepairConfig {
  std::optional<double> noise_m = {};  // [m] (>= 0) deviation of each coordinate; otherwise measured, marker by marker
  UpAxis usual_up = UpAxis::PlusY;     // where the markers do not show which way is up
  std::optional<UpAxis> up = {};       // taken whatever they show
  SequenceConfig sequence = {};
};

struct RepairResult {
  MarkerSequence markers;   // those of the input, in its frame; everything seen or filled
  std::vector<Pose> poses;  // one a frame, world: y up
  MarkerBody body;          // with the markers that were found to be on it
  Eigen::Matrix3d R_world_file = Eigen::Matrix3d::Identity();  // p_world = R_world_file p_file
  std::vector<std::string> loose;  // markers that are on no bone: gaps closed by splines, no noise removed
  double noise_m = 0;              // [m] median over markers
  int outliers = 0;                // samples that were taken for wrong
};

// Fills gaps and removes noise of markers over time, after the uses that MNN-IK (Hu, Zhang, Xia 2021) shows, the whole
// sequence at once: a body of its own size with the markers on it (fitMarkerBody), its poses by the learned prior and
// smoothness (solveSequence), and for each marker what the body does not explain as a steady motion about its bone
// (steadied). Markers whose name says where they sit come first (siteNamed); others join the bone about which they
// hardly move. Error where fewer than kLeastNamedMarkers names are known, or no frame shows as many of them.
// Deterministic.
RepairResult repair(const MarkerSequence& markers, const std::shared_ptr<const LearnedPoses>& learned,
                    const RepairConfig& config);

inline constexpr std::size_t kLeastNamedMarkers = 4;

}  // namespace depthmocap

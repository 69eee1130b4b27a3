#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "libtracker/repair/repair.h"
#include "libtracker/skeleton/skeleton.h"

namespace depthmocap {

// Markers of a true motion, some missing for a while, some with noise.
struct RepairTrial {
  int missing = 0;     // markers, chosen at random
  double gap_s = 0;    // [s] of each gap; the same markers are missing again kBetweenGaps_s after each
  double noise_m = 0;  // [m] deviation of each coordinate
  std::uint64_t seed = 1;
};
inline constexpr double kBetweenGaps_s = 2.0;

enum class RepairMethod { Linear, Spline, Pca, LowPass, Ours };
inline constexpr std::array<std::string_view, 5> kRepairMethodNames = {"linear", "spline", "PCA", "low-pass 6 Hz",
                                                                       "repair"};

// The 18 joints of a motion as markers. joints: [m], one a frame.
MarkerSequence jointMarkers(const std::vector<JointPositions>& joints, double fps);

// The truth with the trial's gaps and noise.
MarkerSequence damaged(const MarkerSequence& truth, const RepairTrial& trial);

// `markers` repaired by a method. Pca without gaps projects on components; LowPass fills by splines first.
MarkerSequence repairedBy(RepairMethod method, const MarkerSequence& markers,
                          const std::shared_ptr<const LearnedPoses>& learned, const RepairConfig& config);

// Mean distance from the truth [m]: of all samples, and of those that are missing in `damaged_markers` (0 if none is).
struct RepairError {
  double all_m = 0;
  double missing_m = 0;
};
RepairError repairError(const MarkerSequence& truth, const MarkerSequence& damaged_markers,
                        const MarkerSequence& repaired);

}  // namespace depthmocap

#include "libtracker/repair/repair_experiment.h"

#include <cmath>
#include <numeric>

#include "libtracker/core/random.h"
#include "libtracker/repair/fill_gaps.h"
#include "libtracker/repair/marker_pca.h"

namespace depthmocap {
namespace {

constexpr double kFirstGap_s = 1.0;  // after the start
constexpr double kCutoff_hz = 6.0;   // usual in gait analysis (Winter 2009)

bool hasGaps(const MarkerSequence& markers) {
  for (const MarkerTrack& track : markers.tracks) {
    if (!track.seen.all()) return true;
  }
  return false;
}

std::vector<std::size_t> someMarkers(std::size_t of, int count, Random& random) {
  std::vector<std::size_t> order(of);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    std::swap(order[i], order[i + random.below(static_cast<std::uint32_t>(of - i))]);
  }
  order.resize(static_cast<std::size_t>(count));
  return order;
}

}  // namespace

MarkerSequence jointMarkers(const std::vector<JointPositions>& joints, double fps) {
  MarkerSequence markers;
  markers.fps = fps;
  for (std::size_t t = 0; t < joints.size(); ++t) {
    markers.frame.push_back(static_cast<std::int64_t>(t));
    markers.time_s.push_back(static_cast<double>(t) / fps);
  }
  markers.addTracks({kJointNames.begin(), kJointNames.end()});
  for (int joint = 0; joint < kJointCount; ++joint) {
    MarkerTrack& track = markers.tracks[static_cast<std::size_t>(joint)];
    for (std::size_t t = 0; t < joints.size(); ++t) track.p.col(static_cast<Eigen::Index>(t)) = joints[t].col(joint);
    track.seen.setConstant(true);
  }
  return markers;
}

MarkerSequence damaged(const MarkerSequence& truth, const RepairTrial& trial) {
  Random random(trial.seed);
  MarkerSequence markers = truth;
  for (MarkerTrack& track : markers.tracks) {
    for (double& x : track.p.reshaped()) x += trial.noise_m * random.normal();
  }
  for (const std::size_t m : someMarkers(markers.tracks.size(), trial.missing, random)) {
    MarkerTrack& track = markers.tracks[m];
    for (std::size_t t = 0; t < markers.frames(); ++t) {
      const double within_s = markers.time_s[t] - kFirstGap_s;
      const double phase_s = std::fmod(within_s, trial.gap_s + kBetweenGaps_s);
      // A gap that the end cuts off would be none to fill but one to guess.
      const double end_s = markers.time_s[t] - phase_s + trial.gap_s;
      if (within_s < 0 || phase_s >= trial.gap_s || end_s >= markers.time_s.back()) continue;
      track.seen[static_cast<Eigen::Index>(t)] = false;
      track.p.col(static_cast<Eigen::Index>(t)).setZero();
    }
  }
  return markers;
}

MarkerSequence repairedBy(RepairMethod method, const MarkerSequence& markers,
                          const std::shared_ptr<const LearnedPoses>& learned, const RepairConfig& config) {
  if (method == RepairMethod::Ours) return repair(markers, learned, config).markers;
  MarkerSequence result = markers;
  if (method == RepairMethod::Pca) {
    if (hasGaps(markers)) {
      fillByPca(result);
    } else {
      projectOnPca(result);
    }
    return result;
  }
  for (MarkerTrack& track : result.tracks) {
    if (method == RepairMethod::Linear) {
      fillLinearly(result.time_s, track);
    } else {
      fillBySpline(result.time_s, track);
    }
  }
  if (method == RepairMethod::LowPass) lowPass(result, kCutoff_hz);
  return result;
}

RepairError repairError(const MarkerSequence& truth, const MarkerSequence& damaged_markers,
                        const MarkerSequence& repaired) {
  RepairError error;
  double samples = 0;
  double missing = 0;
  for (std::size_t m = 0; m < truth.tracks.size(); ++m) {
    const Eigen::VectorXd distance = (repaired.tracks[m].p - truth.tracks[m].p).colwise().norm().transpose();
    const auto& seen = damaged_markers.tracks[m].seen;
    error.all_m += distance.sum();
    samples += static_cast<double>(distance.size());
    error.missing_m += (seen.select(0.0, distance.array())).sum();
    missing += static_cast<double>(seen.size() - seen.count());
  }
  error.all_m /= samples;
  error.missing_m = missing > 0 ? error.missing_m / missing : 0.0;
  return error;
}

}  // namespace depthmocap

#include "libtracker/evaluation/evaluate_poses.h"

#include <cmath>
#include <limits>
#include <numbers>

#include "libtracker/evaluation/match_frames.h"
#include "libtracker/evaluation/mean.h"

namespace depthmocap {

namespace {

// The absolute difference of two angles [rad] in degrees, in [0, 180].
double angleErrorDeg(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi)) * 180.0 / std::numbers::pi;
}

}  // namespace

PoseFigures evaluatePoses(const std::vector<PoseRow>& tracked, const std::vector<PoseRow>& truth,
                          const EvaluationOptions& options) {
  PoseFigures figures;
  std::array<Mean, kDofCount> error_deg;
  Mean root_error_m;
  const FrameMatcher match(tracked);
  for (const PoseRow& truth_row : truth) {
    if (truth_row.frame < options.first || truth_row.frame > options.last) continue;
    const PoseRow* tracked_row = match.find(truth_row.frame);
    if (tracked_row == nullptr) continue;
    ++figures.compared;
    root_error_m.add((tracked_row->q.head<3>() - truth_row.q.head<3>()).norm());
    for (int i = kFirstRotationDof; i < kDofCount; ++i) {
      error_deg[static_cast<std::size_t>(i)].add(angleErrorDeg(tracked_row->q[i], truth_row.q[i]));
    }
  }
  for (int i = 0; i < kDofCount; ++i) figures.error_deg[i] = error_deg[static_cast<std::size_t>(i)].value();
  figures.mean_angle_error_deg = figures.error_deg.tail<kDofCount - kFirstBodyDof>().mean();
  figures.mean_root_position_error_m = root_error_m.value();
  return figures;
}

}  // namespace depthmocap

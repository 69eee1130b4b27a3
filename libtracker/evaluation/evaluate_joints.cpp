#include "libtracker/evaluation/evaluate_joints.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

#include "libtracker/core/stick_figure.h"
#include "libtracker/evaluation/match_frames.h"
#include "libtracker/evaluation/mean.h"

namespace depthmocap {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

bool hasPose(const JointsRow& row) {
  return row.state != TrackState::Lost;
}

JointPositions placed(const JointsRow& row, const EvaluationOptions& options) {
  if (!options.root_relative) return row.p_camera;
  return row.p_camera.colwise() - row.p_camera.col(static_cast<int>(Joint::Pelvis)).eval();
}

void addBoneErrors(const JointPositions& a, const JointPositions& b, Mean& mean) {
  for (const auto& [from, to] : kBoneLines) {
    const Eigen::Vector3d bone_a = a.col(static_cast<int>(to)) - a.col(static_cast<int>(from));
    const Eigen::Vector3d bone_b = b.col(static_cast<int>(to)) - b.col(static_cast<int>(from));
    if (bone_a.isZero() || bone_b.isZero()) continue;  // a bone of no length has no direction
    mean.add(std::atan2(bone_a.cross(bone_b).norm(), bone_a.dot(bone_b)) * kDegrees);
  }
}

double meanAcceleration(const std::vector<JointsRow>& rows, const EvaluationOptions& options) {
  Mean mean;
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const JointsRow& before = rows[i - 1];
    const JointsRow& here = rows[i];
    const JointsRow& after = rows[i + 1];
    const bool inside = before.frame >= options.first && after.frame <= options.last;
    if (!inside || !hasPose(before) || !hasPose(here) || !hasPose(after)) continue;
    const double dt_before = here.time_s - before.time_s;
    const double dt_after = after.time_s - here.time_s;
    const JointPositions acceleration =
        ((after.p_camera - here.p_camera) / dt_after - (here.p_camera - before.p_camera) / dt_before) * 2.0 /
        (dt_before + dt_after);
    for (int joint = 0; joint < kJointCount; ++joint) mean.add(acceleration.col(joint).norm());
  }
  return mean.value();
}

struct JointSums {
  std::array<Mean, kJointCount> error;
  std::array<int, kJointCount> hits{};
  Mean bone_direction;
};

void addFrame(const JointsRow& tracked, const JointsRow& truth, const EvaluationOptions& options, JointSums& sums) {
  const JointPositions difference = placed(tracked, options) - placed(truth, options);
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    const double error = difference.col(static_cast<int>(joint)).norm();
    sums.error[joint].add(error);
    sums.hits[joint] += error <= options.hit_radius_m ? 1 : 0;
  }
  addBoneErrors(tracked.p_camera, truth.p_camera, sums.bone_direction);
}

void summarise(const JointSums& sums, const EvaluationOptions& options, JointFigures& figures) {
  Mean error;
  Mean hit_rate;
  for (std::size_t joint = 0; joint < kJointCount; ++joint) {
    figures.error_m[joint] = sums.error[joint].value();
    figures.hit_rate[joint] = ratio(sums.hits[joint], figures.frames);
    const bool fixed_to_truth = options.root_relative && joint == static_cast<std::size_t>(Joint::Pelvis);
    if (fixed_to_truth) continue;
    error.add(figures.error_m[joint]);
    hit_rate.add(figures.hit_rate[joint]);
  }
  figures.mean_error_m = error.value();
  figures.mean_hit_rate = hit_rate.value();
  figures.mean_bone_direction_error_deg = sums.bone_direction.value();
}

}  // namespace

JointFigures evaluateJoints(const std::vector<JointsRow>& tracked, const std::vector<JointsRow>& truth,
                            const EvaluationOptions& options) {
  JointFigures figures;
  JointSums sums;
  FrameMatcher match(tracked);
  for (const JointsRow& truth_row : truth) {
    const bool inside = truth_row.frame >= options.first && truth_row.frame <= options.last;
    if (!inside || truth_row.state != TrackState::Tracking) continue;
    ++figures.frames;
    const JointsRow* tracked_row = match.find(truth_row.frame);
    if (tracked_row == nullptr || !hasPose(*tracked_row)) continue;
    ++figures.compared;
    addFrame(*tracked_row, truth_row, options, sums);
  }
  figures.lost_fraction = ratio(figures.frames - figures.compared, figures.frames);
  summarise(sums, options, figures);
  figures.jitter_m_s2 = meanAcceleration(tracked, options);
  figures.truth_jitter_m_s2 = meanAcceleration(truth, options);
  return figures;
}

}  // namespace depthmocap

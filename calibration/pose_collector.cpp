#include "calibration/pose_collector.h"

#include <algorithm>
#include <cmath>

#include "libtracker/tracker/alignment.h"

namespace depthmocap {
namespace {

constexpr double kMaxRms_m = 0.06;       // of the markers: a worse fit is not used
constexpr double kMinConfidence = 0.35;  // mean over the joints
constexpr double kLeastChange = 0.6;     // [rad] norm over the limbs' DoFs, from the T-pose and from each other
constexpr int kEvery = 2;                // frames looked at: neighbours say the same
constexpr float kLabelled = 0.8F;        // probability of the part that a pixel's label names
constexpr int kStride_px = 2;
constexpr double kPoseDeviation = 0.20;  // [rad] how far the tracked pose may be wrong

// The DoFs that show where elbows, shoulders, hips and knees are.
constexpr Dof kLimbDofs[] = {kRhumerusRy, kRhumerusRz, kLhumerusRy, kLhumerusRz, kRradiusRy, kLradiusRy,
                             kRfemurRx,   kRfemurRz,   kLfemurRx,   kLfemurRz,   kRtibiaRx,  kLtibiaRx};

double change(const Pose& a, const Pose& b) {
  double sum = 0;
  for (const Dof dof : kLimbDofs) sum += (a[dof] - b[dof]) * (a[dof] - b[dof]);
  return std::sqrt(sum);
}

std::vector<CloudPoint> labelledCloud(const DepthImage& depth, const TrackedFrame& tracked, const CameraModel& camera) {
  std::vector<CloudPoint> cloud;
  for (int y = 0; y < depth.height; y += kStride_px) {
    for (int x = 0; x < depth.width; x += kStride_px) {
      const int label = tracked.labels.at(x, y);
      const auto depth_m = static_cast<double>(depth.at(x, y));
      if (label == 0 || depth_m <= 0) continue;
      CloudPoint point;
      point.p_world = (tracked.R_world_camera * camera.unproject(x, y, depth_m)).cast<float>();
      point.probability.fill((1.0F - kLabelled) / (kPartCount - 1));
      point.probability[static_cast<std::size_t>(label - 1)] = kLabelled;
      cloud.push_back(point);
    }
  }
  return cloud;
}

}  // namespace

PoseCollector::PoseCollector(const CameraModel& camera, int points_per_part)
    : camera_(camera), points_per_part_(points_per_part) {}

void PoseCollector::add(const DepthFrame& frame, const TrackedFrame& tracked) {
  if (frame.frame % kEvery != 0 || tracked.state != TrackState::Tracking) return;
  if (tracked.rms_marker_m > kMaxRms_m || tracked.confidence.mean() < kMinConfidence) return;
  if (change(tracked.q, Pose::Zero()) < kLeastChange) return;
  PoseObservation observation;
  observation.cloud = thinned(labelledCloud(frame.depth, tracked, camera_), points_per_part_);
  observation.markers_world = rotated(tracked.R_world_camera, tracked.markers_camera);
  observation.q = tracked.q;
  observation.deviation.setConstant(kPoseDeviation);
  observation.deviation.head<kFirstBodyDof>().setZero();
  candidates_.push_back(std::move(observation));
}

std::vector<PoseObservation> PoseCollector::chosen(int count) const {
  std::vector<double> distance;
  for (const PoseObservation& candidate : candidates_) distance.push_back(change(candidate.q, Pose::Zero()));
  std::vector<PoseObservation> result;
  while (static_cast<int>(result.size()) < count && !distance.empty()) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest < kLeastChange) break;
    const Pose q = candidates_[static_cast<std::size_t>(farthest - distance.begin())].q;
    result.push_back(candidates_[static_cast<std::size_t>(farthest - distance.begin())]);
    for (std::size_t i = 0; i < distance.size(); ++i) distance[i] = std::min(distance[i], change(candidates_[i].q, q));
  }
  for (PoseObservation& observation : result) observation.weight = 1.0 / static_cast<double>(result.size());
  return result;
}

}  // namespace depthmocap

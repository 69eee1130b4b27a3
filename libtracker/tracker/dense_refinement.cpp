#include "libtracker/tracker/dense_refinement.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace depthmocap {
namespace {

constexpr double kMinExtent_m = 1.0;      // less of a person's height says nothing about the size
constexpr double kTrimmedShare = 0.0005;  // of the pixels at either end: stray ones

// A camera sees this share of a person's height: crown and soles are lost at the edge of the silhouette (rendered with
// the noise of Kinect v1 the measured stature fell short by 2.8 to 3.3 % on three motions).
constexpr double kSeenShare = 0.97;

// Distance [m] between the lowest and the highest value without the trimmed ones; reorders the values.
double trimmedExtent(std::vector<float>& values) {
  const auto trimmed = static_cast<std::ptrdiff_t>(kTrimmedShare * static_cast<double>(values.size()));
  if (values.empty()) return 0;
  const auto low = values.begin() + trimmed;
  std::nth_element(values.begin(), low, values.end());
  const double lowest = static_cast<double>(*low);
  const auto high = values.end() - 1 - trimmed;
  std::nth_element(values.begin(), high, values.end());
  return static_cast<double>(*high) - lowest;
}

}  // namespace

void DenseRefinement::observe(const ClassifiedPixels& pixels, const DepthImage& depth, const MaskImage& mask,
                              const CameraModel& camera, const Eigen::Matrix3d& R_world_camera) {
  free_space_.observe(depth, mask, camera, R_world_camera);
  samples_.clear();
  const std::size_t count = pixels.pixels.size();
  const std::size_t wanted = std::min<std::size_t>(count, kMaxSurfaceMatches);
  for (std::size_t i = 0; i < wanted; ++i) {
    const auto& pixel = pixels.pixels[i * count / wanted];
    SurfaceSample sample;
    sample.p_world =
        (R_world_camera * camera.unproject(pixel.x, pixel.y, static_cast<double>(pixel.depth_m))).cast<float>();
    sample.probability = pixel.probability;
    samples_.push_back(sample);
  }
  heights_.clear();
  for (const auto& pixel : pixels.pixels) {
    const auto depth_m = static_cast<double>(pixel.depth_m);
    heights_.push_back(static_cast<float>(R_world_camera.row(1) * camera.unproject(pixel.x, pixel.y, depth_m)));
  }
  observed_extent_m_ = trimmedExtent(heights_);
}

double DenseRefinement::extentRatio(const SurfaceModel& surface, const ActorModel& actor, const Pose& q) {
  if (surface.stature_m <= 0 || observed_extent_m_ < kMinExtent_m) return 0;
  const auto scale = static_cast<float>(statureOf(actor.skeleton.lengths) / surface.stature_m);
  fk_.update(actor.skeleton, q);
  float lowest = std::numeric_limits<float>::max();
  float highest = std::numeric_limits<float>::lowest();
  for (const auto& part : surface.parts) {
    for (const SurfaceModel::Point& point : part) {
      const double y = fk_.position({point.bone, (scale * point.p_bone).cast<double>()}).y();
      lowest = std::min(lowest, static_cast<float>(y));
      highest = std::max(highest, static_cast<float>(y));
    }
  }
  return highest > lowest ? observed_extent_m_ / (kSeenShare * static_cast<double>(highest - lowest)) : 0;
}

void DenseRefinement::place(const SurfaceModel& surface, const ActorModel& actor, const Pose& q) {
  fk_.update(actor.skeleton, q);
  placed_.place(surface, statureOf(actor.skeleton.lengths) / surface.stature_m, fk_);
}

void DenseRefinement::refine(const SurfaceModel& surface, const ActorModel& actor, MapInput input, MapSolver& solver,
                             Pose& q, MapSummary& summary) {
  if (surface.stature_m <= 0) return;
  int iterations = summary.iterations;
  for (int round = 0; round < rounds_; ++round) {
    place(surface, actor, q);
    matcher_.match(placed_, samples_, matches_);
    free_space_.match(placed_, matches_);
    input.surface = &matches_;
    summary = solver.solve(input, q);
    iterations += summary.iterations;
  }
  summary.iterations = iterations;
}

}  // namespace depthmocap

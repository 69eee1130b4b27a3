#include "libtracker/tracker/dense_refinement.h"

#include <algorithm>

namespace depthmocap {

void DenseRefinement::observe(const ClassifiedPixels& pixels, const CameraModel& camera,
                              const Eigen::Matrix3d& R_world_camera) {
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
}

void DenseRefinement::refine(const SurfaceModel& surface, const ActorModel& actor, MapInput input, MapSolver& solver,
                             Pose& q, MapSummary& summary) {
  if (surface.stature_m <= 0) return;
  const double scale = statureOf(actor.skeleton.lengths) / surface.stature_m;
  int iterations = summary.iterations;
  for (int round = 0; round < rounds_; ++round) {
    fk_.update(actor.skeleton, q);
    matcher_.match(surface, scale, fk_, samples_, matches_);
    input.surface = &matches_;
    summary = solver.solve(input, q);
    iterations += summary.iterations;
  }
  summary.iterations = iterations;
}

}  // namespace depthmocap

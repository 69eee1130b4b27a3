#include "libtracker/tracker/dense_refinement.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

namespace depthmocap {
namespace {

constexpr double kMinExtent_m = 1.0;      // less of a person's height says nothing about the size
constexpr double kTrimmedShare = 0.0005;  // of the pixels at either end: stray ones

// A camera sees this share of a person's height: crown and soles are lost at the edge of the silhouette. Chosen so that
// the statures of five motions with the noise of Kinect v1 are right on average.
constexpr double kSeenShare = 0.985;

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

// Worth of the matches of depth: usual is a Kinect v1 on walks, at which MapConfig::lambda_surface was chosen. Neither
// a frame of bad fits nor a rendered one without noise may change it by more than the range.
constexpr MatchNoise::Range kDepthNoise{0.010, 0.5, 6.0, 2.0};
// Of the outline: usual is the same on a body of the right shape. Loose clothes and average bodies lie off it by two
// centimetres, and little is to be believed of it then; at first it is not known whether this one does.
constexpr MatchNoise::Range kOutlineNoise{0.010, 0.01, 1.5, 4.0};
constexpr double kFirstOutline_m = 0.02;

// [m] A point as far off its surface is explained by nothing.
constexpr double kMisfit_m = 0.15;

}  // namespace

DenseRefinement::DenseRefinement(const SurfaceMatchConfig& surface, const OutlineConfig& outline,
                                 const FreeSpaceConfig& free_space, bool on)
    : matcher_(surface),
      outline_(outline),
      free_space_(free_space),
      on_(on),
      noise_(kDepthNoise, kDepthNoise.usual_m),
      outline_noise_(kOutlineNoise, kFirstOutline_m) {}

void DenseRefinement::forget() {
  noise_ = {kDepthNoise, kDepthNoise.usual_m};
  outline_noise_ = {kOutlineNoise, kFirstOutline_m};
}

void DenseRefinement::look(const DepthImage& depth, const MaskImage& mask, bool whole, const CameraModel& camera,
                           const Eigen::Matrix3d& R_world_camera) {
  whole_ = whole;
  camera_ = camera;
  R_world_camera_ = R_world_camera;
  if (!on_) return;
  outline_.observe(depth, mask, camera, R_world_camera);
  free_space_.observe(depth, mask, camera, R_world_camera);
}

ExtentEvidence DenseRefinement::extent(const ClassifiedPixels& pixels, const Actor& actor, const Pose& q) {
  heights_.clear();
  for (const auto& pixel : pixels.pixels) {
    const Eigen::Vector3d p_camera = camera_.unproject(pixel.x, pixel.y, static_cast<double>(pixel.depth_m));
    heights_.push_back(static_cast<float>(R_world_camera_.row(1) * p_camera));
  }
  const double observed_extent_m = trimmedExtent(heights_);
  if (observed_extent_m < kMinExtent_m) return {};
  const auto scale = static_cast<float>(actor.stature_m() / actor.surface->stature_m);
  fk_.update(actor.skeleton, q);
  float lowest = std::numeric_limits<float>::max();
  float highest = std::numeric_limits<float>::lowest();
  for (const auto& part : actor.surface->parts) {
    for (const SurfaceModel::Point& point : part) {
      const double y = fk_.position({point.bone, (scale * point.p_bone).cast<double>()}).y();
      lowest = std::min(lowest, static_cast<float>(y));
      highest = std::max(highest, static_cast<float>(y));
    }
  }
  const auto height_m = static_cast<double>(highest - lowest);
  if (height_m <= 0) return {};
  return {observed_extent_m / (kSeenShare * height_m), height_m / actor.stature_m()};
}

void DenseRefinement::refine(const std::vector<SurfaceSample>& samples, Matching matching, const Actor& actor,
                             MapInput input, MapSolver& solver, DenseRounds rounds, Pose& q, MapSummary& summary) {
  int iterations = summary.iterations;
  std::swap(pairs_, pairs_before_);
  SurfaceMatches& matches = pairs_.matches;
  matches.clear();
  pairs_.measured = pairs_.touched = 0;
  matcher_.observe(samples, matching);
  for (int round = 0; on_ && round < rounds.count; ++round) {
    fk_.update(actor.skeleton, q);
    placed_.place(*actor.surface, actor.stature_m() / actor.surface->stature_m, fk_);
    matcher_.match(placed_, matches);
    pairs_.measured = matches.size();
    for (SurfaceMatch& match : matches) match.weight *= noise_.information();
    outline_.match(*actor.surface, actor.stature_m() / actor.surface->stature_m, fk_, matches);
    pairs_.touched = matches.size() - pairs_.measured;
    for (std::size_t i = pairs_.measured; i < matches.size(); ++i) matches[i].weight *= outline_noise_.information();
    free_space_.match(placed_, whole_, matches);
    input.surface = &matches;
    summary = solver.solve(input, q, rounds.steps);
    iterations += summary.iterations;
  }
  summary.iterations = iterations;
}

void DenseRefinement::takeBack() {
  std::swap(pairs_, pairs_before_);
}

std::optional<double> DenseRefinement::misfit(const Actor& actor, const Pose& q) {
  if (!on_) return std::nullopt;
  fk_.update(actor.skeleton, q);
  placed_.place(*actor.surface, actor.stature_m() / actor.surface->stature_m, fk_);
  return matcher_.unexplained(placed_, kMisfit_m) + free_space_.hanging(placed_, whole_, kMisfit_m);
}

void DenseRefinement::learnNoise(const Actor& actor, const Pose& q) {
  fk_.update(actor.skeleton, q);
  noise_.observe(measured(), fk_);
  outline_noise_.observe(outline(), fk_);
}

}  // namespace depthmocap

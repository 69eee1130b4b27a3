#include "libtracker/ik/image_ik.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

// Pictures that a sequence is followed from.
constexpr std::size_t kAnchors = 6;
// [m] what a joint in a picture is off by at least: people and programs mark joints no better.
constexpr double kLeastNoise_m = 0.005;

ImageStarts startsOf(const IkSolver& solver, const ImageProjection& projection, const ImageTargets& targets) {
  if (targets.targets.size() < kLeastImageTargets) {
    throw Error(fmt::format("{} joints are given; a picture needs {}", targets.targets.size(), kLeastImageTargets),
                "targets");
  }
  ImageStarts starts = imageStarts(solver.skeleton(), projection, targets, solver.typicalShapes());
  if (starts.poses.empty()) throw Error("the joints are no upright person's", "targets", "v may point the other way");
  return starts;
}

IkResult finished(IkResult result, ImageTerm& term, const ImageProjection& projection) {
  result.residual_m = term.rms(result.q);
  if (projection.kind == Projection::Orthographic) result.q[kRootTz] = 0;
  result.q[kRootRy] = std::remainder(result.q[kRootRy], 2.0 * std::numbers::pi);
  return result;
}

struct Path {
  std::vector<Pose> poses;
  double energy = 0;
};

class Follower {
 public:
  Follower(const IkSolver& solver, const ImageProjection& projection, const std::vector<ImageTargets>& targets)
      : solver_(solver), targets_(targets) {
    const ImageStarts first = startsOf(solver, projection, targets.front());
    scale_ = first.scale;
    for (const ImageTargets& target : targets) {
      terms_.push_back(std::make_unique<ImageTerm>(solver.skeleton(), projection, target, scale_));
    }
    projection_ = projection;
  }
  [[nodiscard]] double scale() const { return scale_; }

  Path from(std::size_t anchor) {
    Path path{std::vector<Pose>(targets_.size()), 0};
    ImageStarts starts = startsOf(solver_, projection_, targets_[anchor]);
    if (projection_.kind == Projection::Orthographic) {
      for (Pose& q : starts.poses) q[kRootTz] += std::log(starts.scale / scale_);
    }
    step(path, anchor, starts.poses);
    for (std::size_t t = anchor + 1; t < targets_.size(); ++t) step(path, t, {path.poses[t - 1]});
    for (std::size_t t = anchor; t-- > 0;) step(path, t, {path.poses[t + 1]});
    return path;
  }

 private:
  void step(Path& path, std::size_t t, const std::vector<Pose>& starts) {
    const IkSolution found = solver_.solveFrom(starts, *terms_[t]);
    path.poses[t] = found.result.q;
    path.energy += found.energy;
    if (starts.size() > 1) return;
    const double turn = std::remainder(path.poses[t][kRootRy] - starts[0][kRootRy], 2.0 * std::numbers::pi);
    path.poses[t][kRootRy] = starts[0][kRootRy] + turn;
  }

  const IkSolver& solver_;
  const std::vector<ImageTargets>& targets_;
  ImageProjection projection_;
  double scale_ = 1;
  std::vector<std::unique_ptr<ImageTerm>> terms_;
};

}  // namespace

IkResult solveImage(const IkSolver& solver, const ImageProjection& projection, const ImageTargets& targets) {
  const ImageStarts starts = startsOf(solver, projection, targets);
  ImageTerm term(solver.skeleton(), projection, targets, starts.scale);
  return finished(solver.solveFrom(starts.poses, term).result, term, projection);
}

std::vector<IkResult> solveImageSequence(const IkSolver& solver, const ImageProjection& projection,
                                         const std::vector<ImageTargets>& targets, const std::vector<double>& time_s,
                                         const SequenceConfig& config) {
  DMC_CHECK(!targets.empty() && targets.size() == time_s.size());
  for (const ImageTargets& target : targets) (void)startsOf(solver, projection, target);
  Follower follower(solver, projection, targets);
  Path best;
  const std::size_t anchors = std::min(kAnchors, targets.size());
  for (std::size_t a = 0; a < anchors; ++a) {
    Path path = follower.from(a * targets.size() / anchors);
    if (a == 0 || path.energy < best.energy) best = std::move(path);
  }
  std::vector<SequenceFrame> frames(targets.size());
  const double noise_m = std::max(kLeastNoise_m, solver.weight_m());
  for (std::size_t t = 0; t < frames.size(); ++t) {
    frames[t].time_s = time_s[t];
    frames[t].measured =
        std::make_unique<ImageTerm>(solver.skeleton(), projection, targets[t], follower.scale(), noise_m);
  }
  const std::vector<Pose> poses = solveSequence(frames, solver.posePrior(), config, std::move(best.poses));
  std::vector<IkResult> results;
  for (std::size_t t = 0; t < poses.size(); ++t) {
    ImageTerm term(solver.skeleton(), projection, targets[t], follower.scale());
    results.push_back(finished({poses[t], 0, 0}, term, projection));
  }
  return results;
}

}  // namespace depthmocap

#include "libtracker/repair/repair.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/repair/fill_gaps.h"
#include "libtracker/repair/first_poses.h"
#include "libtracker/repair/steady_track.h"
#include "libtracker/repair/up_direction.h"

namespace depthmocap {
namespace {

// [s] between the frames whose poses are found one by one; in between a pose hardly leaves the straight line.
constexpr double kKeyframe_s = 0.25;
// Of those the body is fitted to so many: more tell hardly more about it.
constexpr std::size_t kBodyViews = 60;
// [m] weight of the prior in the poses of keyframes: what a marker is off by on a body that is known roughly.
constexpr double kFirstWeight_m = 0.01;
// [m] what a marker's place on a rigid bone is off by, for the first solve; then it is measured.
constexpr double kFirstMisfit_m = 0.01;
constexpr double kLeastMisfit_m = 0.006;
// [s] over which a marker's motion about its bone is correlated.
constexpr double kSteady_s = 0.3;
// A sample is wrong that lies so many deviations, and so many metres, off.
constexpr double kOutlierDeviations = 6.0;
constexpr double kOutlier_m = 0.06;
// [m] deviation of a marker about a bone that it is rigid with.
constexpr double kRigid_m = 0.05;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Repair {
 public:
  Repair(const MarkerSequence& input, const std::shared_ptr<const LearnedPoses>& learned, const RepairConfig& config)
      : input_(input), learned_(learned), config_(config), world_(input) {
    bindNamed();
    result_.R_world_file = worldFromFile(input, body(), config);
    for (MarkerTrack& track : world_.tracks) {
      track.p = (result_.R_world_file * track.p).eval();
      noise_m_.push_back(config.noise_m ? std::max(*config.noise_m, kLeastNoise_m) : markerNoise(track.p, track.seen));
    }
    result_.noise_m = median(noise_m_);
  }

  RepairResult run() {
    look();
    fitBody();
    misfit_m_.assign(body().markers.size(), kFirstMisfit_m);
    solvePoses();
    const bool has_more = bindLoose();
    measureMisfit();
    judge();
    if (result_.outliers > 0 || has_more) {
      look();
      solvePoses();
      measureMisfit();
      judge();  // wrong samples had pulled those beside them off, too
    }
    writeMarkers();
    return std::move(result_);
  }

 private:
  MarkerBody& body() { return result_.body; }
  [[nodiscard]] Eigen::Index frames() const { return static_cast<Eigen::Index>(world_.frames()); }

  void bindNamed();
  bool bindLoose();
  void look();
  void fitBody();
  void solvePoses();
  void measureMisfit();
  void judge();
  void writeMarkers();
  // The track from the marker's place on the body, in its bone's frame [m].
  [[nodiscard]] Eigen::Matrix3Xd aboutBone(const MarkerTrack& track, const BonePoint& point);

  const MarkerSequence& input_;
  std::shared_ptr<const LearnedPoses> learned_;
  RepairConfig config_;
  MarkerSequence world_;
  std::vector<double> noise_m_;   // of each track
  std::vector<double> misfit_m_;  // of each marker of the body
  std::vector<MarkerView> views_;
  RepairResult result_;
};

void Repair::bindNamed() {
  for (std::size_t i = 0; i < input_.tracks.size(); ++i) {
    const auto site = siteNamed(input_.tracks[i].name);
    if (site && input_.tracks[i].seen.any()) body().markers.push_back({i, *site, Eigen::Vector3d::Zero()});
  }
  if (body().markers.size() >= kLeastNamedMarkers) return;
  throw Error(fmt::format("{} of {} markers have a name that says where on the body they are; {} are needed",
                          body().markers.size(), input_.tracks.size(), kLeastNamedMarkers),
              "markers", "name some after joints (left_wrist, ...) or as in Plug-in Gait; --names gives names");
}

void Repair::look() {
  views_.assign(world_.frames(), {});
  for (std::size_t m = 0; m < body().markers.size(); ++m) {
    const MarkerTrack& track = world_.tracks[body().markers[m].track];
    for (Eigen::Index t = 0; t < frames(); ++t) {
      if (!track.seen[t]) continue;
      views_[static_cast<std::size_t>(t)].markers.push_back(m);
      views_[static_cast<std::size_t>(t)].p.emplace_back(track.p.col(t));
    }
  }
}

void Repair::fitBody() {
  const auto keyframes = keyframesOf(views_, world_.time_s, kLeastNamedMarkers, kKeyframe_s);
  if (keyframes.empty()) {
    throw Error(fmt::format("no frame shows {} markers of the body", kLeastNamedMarkers), "markers");
  }
  std::vector<MarkerView> views;
  const std::size_t count = std::min(kBodyViews, keyframes.size());
  for (std::size_t k = 0; k < count; ++k) views.push_back(views_[keyframes[k * keyframes.size() / count]]);
  body().skeleton = makeSkeleton(BoneLengths{}.scaled(std::clamp(roughScale(body(), views), 0.3, 3.0)));
  IkConfig config;
  config.prior = IkPrior::Gmm;
  config.weight_m = kFirstWeight_m;
  const IkSolver rough(body().skeleton, config, learned_);
  std::vector<Pose> poses;
  poses.reserve(views.size());
  for (const MarkerView& view : views) poses.push_back(rough.solve(viewTargets(body(), view)).q);
  fitMarkerBody(body(), views, rough.posePrior(), poses);
  const IkSolver solver(body().skeleton, config, learned_);
  result_.poses = firstPoses(solver, body(), views_, world_.time_s, keyframes, config_.sequence.threads);
}

void Repair::solvePoses() {
  std::vector<SequenceFrame> frames(world_.frames());
  for (std::size_t t = 0; t < frames.size(); ++t) {
    frames[t].time_s = world_.time_s[t];
    if (views_[t].empty()) continue;
    PointTargets targets = viewTargets(body(), views_[t]);
    for (std::size_t i = 0; i < views_[t].markers.size(); ++i) {
      const std::size_t m = views_[t].markers[i];
      targets.targets[i].weight = 1.0 / std::hypot(misfit_m_[m], noise_m_[body().markers[m].track]);
    }
    frames[t].measured = std::make_unique<TargetTerm>(body().skeleton, std::move(targets));
  }
  const GaussianPrior prior(learned_->mixture);
  result_.poses = solveSequence(frames, &prior, config_.sequence, std::move(result_.poses));
}

Eigen::Matrix3Xd Repair::aboutBone(const MarkerTrack& track, const BonePoint& point) {
  Eigen::Matrix3Xd local(3, frames());
  ForwardKinematics fk;
  for (Eigen::Index t = 0; t < frames(); ++t) {
    fk.update(body().skeleton, result_.poses[static_cast<std::size_t>(t)]);
    local.col(t) = fk.R_world_bone(point.bone).transpose() * (track.p.col(t) - fk.position(point));
  }
  return local;
}

// Per marker the deviation about the body beyond noise, by medians: outliers do not count.
void Repair::measureMisfit() {
  misfit_m_.assign(body().markers.size(), kFirstMisfit_m);
  for (std::size_t m = 0; m < body().markers.size(); ++m) {
    const std::size_t i = body().markers[m].track;
    const Eigen::Matrix3Xd local = aboutBone(world_.tracks[i], body().point(m));
    std::vector<double> squares;
    for (Eigen::Index t = 0; t < frames(); ++t) {
      if (world_.tracks[i].seen[t]) squares.push_back(local.col(t).squaredNorm());
    }
    if (squares.empty()) continue;
    // The median of the square of a normal vector is 2.37 times the variance of a coordinate.
    const double variance = median(std::move(squares)) / 2.37 - noise_m_[i] * noise_m_[i];
    misfit_m_[m] = std::sqrt(std::max(variance, kLeastMisfit_m * kLeastMisfit_m));
  }
}

// Says which samples count as seen: those that were, but for what lies far off the body.
void Repair::judge() {
  result_.outliers = 0;
  for (std::size_t m = 0; m < body().markers.size(); ++m) {
    const std::size_t i = body().markers[m].track;
    const double limit_m = std::max(kOutlier_m, kOutlierDeviations * std::hypot(misfit_m_[m], noise_m_[i]));
    const Eigen::Matrix3Xd local = aboutBone(world_.tracks[i], body().point(m));
    for (Eigen::Index t = 0; t < frames(); ++t) {
      const bool is_near = local.col(t).norm() <= limit_m;
      world_.tracks[i].seen[t] = input_.tracks[i].seen[t] && is_near;
      if (input_.tracks[i].seen[t] && !is_near) ++result_.outliers;
    }
  }
}

// Markers without a known name join the bone in whose frame they move least.
bool Repair::bindLoose() {
  std::vector<bool> is_bound(world_.tracks.size(), false);
  for (const MarkerBody::Marker& marker : body().markers) is_bound[marker.track] = true;
  bool has_more = false;
  for (std::size_t i = 0; i < world_.tracks.size(); ++i) {
    if (is_bound[i]) continue;
    const MarkerTrack& track = world_.tracks[i];
    double least_m = kRigid_m;
    MarkerBody::Marker best{i, {}, {}};
    for (int b = 0; b < kBoneCount && track.seen.any(); ++b) {
      const MarkerSite origin{static_cast<Bone>(b), 0, Eigen::Vector3d::Zero(), kRigid_m};
      const Eigen::Matrix3Xd local = aboutBone(track, sitePoint(origin, body().skeleton));
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      double square = 0;
      const auto count = static_cast<double>(track.seen.count());
      for (Eigen::Index t = 0; t < frames(); ++t) mean += (track.seen[t] ? 1.0 : 0.0) / count * local.col(t);
      for (Eigen::Index t = 0; t < frames(); ++t) {
        square += track.seen[t] ? (local.col(t) - mean).squaredNorm() / (3.0 * count) : 0.0;
      }
      const double deviation_m = std::sqrt(std::max(0.0, square - noise_m_[i] * noise_m_[i]));
      if (!(deviation_m < least_m)) continue;
      least_m = deviation_m;
      best = {i, origin, mean};
    }
    if (least_m < kRigid_m) {
      body().markers.push_back(best);
      has_more = true;
    } else {
      result_.loose.push_back(track.name);
    }
  }
  return has_more;
}

void Repair::writeMarkers() {
  for (std::size_t m = 0; m < body().markers.size(); ++m) {
    const std::size_t i = body().markers[m].track;
    const BonePoint point = body().point(m);
    const SteadyConfig config{std::max(misfit_m_[m], kLeastMisfit_m), kSteady_s, noise_m_[i]};
    const Eigen::Matrix3Xd local =
        steadied(aboutBone(world_.tracks[i], point), world_.tracks[i].seen, world_.time_s, config);
    ForwardKinematics fk;
    for (Eigen::Index t = 0; t < frames(); ++t) {
      fk.update(body().skeleton, result_.poses[static_cast<std::size_t>(t)]);
      world_.tracks[i].p.col(t) = fk.position({point.bone, point.p_bone + local.col(t)});
    }
    world_.tracks[i].seen.setConstant(true);
  }
  for (MarkerTrack& track : world_.tracks) {
    if (std::find(result_.loose.begin(), result_.loose.end(), track.name) != result_.loose.end()) {
      fillBySpline(world_.time_s, track);
    }
    track.p = (result_.R_world_file.transpose() * track.p).eval();
  }
  result_.markers = std::move(world_);
}

}  // namespace

RepairResult repair(const MarkerSequence& markers, const std::shared_ptr<const LearnedPoses>& learned,
                    const RepairConfig& config) {
  return Repair(markers, learned, config).run();
}

}  // namespace depthmocap

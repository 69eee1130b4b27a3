#include "libtracker/repair/fill_gaps.h"

#include <algorithm>

namespace depthmocap {
namespace {

std::vector<std::size_t> seenFrames(const MarkerTrack& track) {
  std::vector<std::size_t> frames;
  for (Eigen::Index t = 0; t < track.p.cols(); ++t) {
    if (track.seen[t]) frames.push_back(static_cast<std::size_t>(t));
  }
  return frames;
}

Eigen::Vector3d at(const MarkerTrack& track, std::size_t frame) {
  return track.p.col(static_cast<Eigen::Index>(frame));
}

// Second derivatives of the natural cubic spline through the samples (Thomas' algorithm).
std::vector<Eigen::Vector3d> curvatures(const std::vector<double>& time_s, const MarkerTrack& track,
                                        const std::vector<std::size_t>& knots) {
  const std::size_t count = knots.size();
  std::vector<Eigen::Vector3d> curvature(count, Eigen::Vector3d::Zero());
  std::vector<double> above(count, 0.0);
  const auto step = [&](std::size_t k) { return time_s[knots[k + 1]] - time_s[knots[k]]; };
  const auto slope = [&](std::size_t k) -> Eigen::Vector3d {
    return (at(track, knots[k + 1]) - at(track, knots[k])) / step(k);
  };
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double pivot = 2.0 * (step(k - 1) + step(k)) - step(k - 1) * above[k - 1];
    above[k] = step(k) / pivot;
    curvature[k] = (6.0 * (slope(k) - slope(k - 1)) - step(k - 1) * curvature[k - 1]) / pivot;
  }
  for (std::size_t k = count; k-- > 0;) {
    if (k + 1 < count) curvature[k] -= above[k] * curvature[k + 1];
  }
  return curvature;
}

template <typename Between>
void fill(MarkerTrack& track, const std::vector<std::size_t>& knots, const Between& between) {
  if (knots.empty()) return;
  std::size_t next = 0;
  for (std::size_t t = 0; t < static_cast<std::size_t>(track.p.cols()); ++t) {
    while (next < knots.size() && knots[next] < t) ++next;
    const auto column = static_cast<Eigen::Index>(t);
    if (track.seen[column]) continue;
    if (next == 0 || next == knots.size()) {
      track.p.col(column) = at(track, next == 0 ? knots.front() : knots.back());
    } else {
      track.p.col(column) = between(next - 1, t);
    }
  }
  track.seen.setConstant(true);
}

}  // namespace

void fillLinearly(const std::vector<double>& time_s, MarkerTrack& track) {
  const std::vector<std::size_t> knots = seenFrames(track);
  const MarkerTrack samples = track;
  fill(track, knots, [&](std::size_t k, std::size_t t) -> Eigen::Vector3d {
    const double share = (time_s[t] - time_s[knots[k]]) / (time_s[knots[k + 1]] - time_s[knots[k]]);
    return (1.0 - share) * at(samples, knots[k]) + share * at(samples, knots[k + 1]);
  });
}

void fillBySpline(const std::vector<double>& time_s, MarkerTrack& track) {
  const std::vector<std::size_t> knots = seenFrames(track);
  const MarkerTrack samples = track;
  const std::vector<Eigen::Vector3d> curvature = curvatures(time_s, track, knots);
  fill(track, knots, [&](std::size_t k, std::size_t t) -> Eigen::Vector3d {
    const double h = time_s[knots[k + 1]] - time_s[knots[k]];
    const double b = (time_s[t] - time_s[knots[k]]) / h;
    const double a = 1.0 - b;
    return a * at(samples, knots[k]) + b * at(samples, knots[k + 1]) +
           ((a * a * a - a) * curvature[k] + (b * b * b - b) * curvature[k + 1]) * h * h / 6.0;
  });
}

}  // namespace depthmocap

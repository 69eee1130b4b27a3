#include "libtracker/repair/marker_pca.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "libtracker/repair/fill_gaps.h"

namespace depthmocap {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Share of the variance that components leave out, as noise of every coordinate.
constexpr double kNoiseShare = 1e-4;
constexpr double kKeptShare = 0.99;

// Frames as rows of coordinates about the mean of some markers.
MatrixXd centred(const MarkerSequence& markers, const std::vector<std::size_t>& anchors, MatrixXd& middle) {
  const auto frames = static_cast<Index>(markers.frames());
  middle = MatrixXd::Zero(3, frames);
  for (const std::size_t anchor : anchors) middle += markers.tracks[anchor].p / static_cast<double>(anchors.size());
  MatrixXd rows(frames, 3 * static_cast<Index>(markers.tracks.size()));
  for (std::size_t m = 0; m < markers.tracks.size(); ++m) {
    rows.middleCols<3>(3 * static_cast<Index>(m)) = (markers.tracks[m].p - middle).transpose();
  }
  return rows;
}

struct Gaussian {
  VectorXd mean;
  MatrixXd covariance;
};

Gaussian gaussianOf(const MatrixXd& rows) {
  Gaussian g;
  g.mean = rows.colwise().mean().transpose();
  const MatrixXd about = rows.rowwise() - g.mean.transpose();
  g.covariance = about.transpose() * about / static_cast<double>(std::max<Index>(1, rows.rows() - 1));
  return g;
}

// The missing coordinates' mean given the others.
void regress(const Gaussian& g, const std::vector<Index>& seen, const std::vector<Index>& missing, VectorXd& row) {
  MatrixXd S = g.covariance(seen, seen);
  S.diagonal().array() += kNoiseShare * g.covariance.trace() / static_cast<double>(g.mean.size());
  const VectorXd about = row(seen) - g.mean(seen);
  row(missing) = g.mean(missing) + g.covariance(missing, seen) * S.llt().solve(about);
}

// Moves what was filled so that it meets the samples at both ends of its gap.
void meetEnds(const MarkerTrack& before, const MatrixXd& estimate, const std::vector<double>& time_s,
              MarkerTrack& track) {
  MarkerTrack difference{track.name, before.p - estimate, before.seen};
  fillLinearly(time_s, difference);
  track.p = estimate + difference.p;
  track.seen.setConstant(true);
}

}  // namespace

void fillByPca(MarkerSequence& markers) {
  std::vector<std::size_t> anchors;
  for (std::size_t m = 0; m < markers.tracks.size(); ++m) {
    if (markers.tracks[m].seen.all()) anchors.push_back(m);
  }
  std::vector<Index> whole;
  for (Index t = 0; t < static_cast<Index>(markers.frames()); ++t) {
    bool all = true;
    for (const MarkerTrack& track : markers.tracks) all = all && track.seen[t];
    if (all) whole.push_back(t);
  }
  if (anchors.empty() || whole.size() < 10) {
    for (MarkerTrack& track : markers.tracks) fillBySpline(markers.time_s, track);
    return;
  }
  MatrixXd middle;
  const MatrixXd rows = centred(markers, anchors, middle);
  const Gaussian g = gaussianOf(rows(whole, Eigen::all));
  MatrixXd estimate = rows;
  for (Index t = 0; t < rows.rows(); ++t) {
    // What components say of a marker that is seen is needed, too, where a gap ends: so each gap's own frames and its
    // ends are estimated without that marker.
    std::vector<Index> seen;
    std::vector<Index> missing;
    for (std::size_t m = 0; m < markers.tracks.size(); ++m) {
      const bool is_anchor = markers.tracks[m].seen.all();
      for (Index axis = 0; axis < 3; ++axis) (is_anchor ? seen : missing).push_back(3 * static_cast<Index>(m) + axis);
    }
    if (missing.empty()) break;
    VectorXd row = rows.row(t).transpose();
    regress(g, seen, missing, row);
    estimate.row(t) = row.transpose();
  }
  for (std::size_t m = 0; m < markers.tracks.size(); ++m) {
    const MarkerTrack before = markers.tracks[m];
    if (before.seen.all()) continue;
    const MatrixXd place = estimate.middleCols<3>(3 * static_cast<Index>(m)).transpose() + middle;
    meetEnds(before, place, markers.time_s, markers.tracks[m]);
  }
}

void projectOnPca(MarkerSequence& markers) {
  std::vector<std::size_t> all(markers.tracks.size());
  for (std::size_t m = 0; m < all.size(); ++m) all[m] = m;
  MatrixXd middle;
  const MatrixXd rows = centred(markers, all, middle);
  const Gaussian g = gaussianOf(rows);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> components(g.covariance);
  const double total = components.eigenvalues().sum();
  Index kept = 0;
  double held = 0;
  while (kept < g.mean.size() && held < kKeptShare * total) held += components.eigenvalues()[g.mean.size() - ++kept];
  const MatrixXd basis = components.eigenvectors().rightCols(kept);
  const MatrixXd projected =
      ((rows.rowwise() - g.mean.transpose()) * basis * basis.transpose()).rowwise() + g.mean.transpose();
  for (std::size_t m = 0; m < all.size(); ++m) {
    markers.tracks[m].p = projected.middleCols<3>(3 * static_cast<Index>(m)).transpose() + middle;
  }
}

void lowPass(MarkerSequence& markers, double cutoff_hz) {
  // Two passes of second order: the cutoff of each is raised so that both together have -3 dB at the one asked for.
  const double raised = cutoff_hz / std::pow(std::sqrt(2.0) - 1.0, 0.25);
  const double w = std::tan(std::min(1.5, std::numbers::pi * raised / markers.fps));
  const double norm = 1.0 + std::numbers::sqrt2 * w + w * w;
  const double b0 = w * w / norm;
  const double a1 = 2.0 * (w * w - 1.0) / norm;
  const double a2 = (1.0 - std::numbers::sqrt2 * w + w * w) / norm;
  const auto pass = [&](Eigen::Matrix3Xd& p) {
    Eigen::Vector3d x1 = p.col(0);
    Eigen::Vector3d x2 = p.col(0);
    Eigen::Vector3d y1 = p.col(0);
    Eigen::Vector3d y2 = p.col(0);
    for (Index t = 0; t < p.cols(); ++t) {
      const Eigen::Vector3d x = p.col(t);
      const Eigen::Vector3d y = b0 * (x + 2.0 * x1 + x2) - a1 * y1 - a2 * y2;
      x2 = x1;
      x1 = x;
      y2 = y1;
      y1 = y;
      p.col(t) = y;
    }
  };
  for (MarkerTrack& track : markers.tracks) {
    pass(track.p);
    track.p = track.p.rowwise().reverse().eval();
    pass(track.p);
    track.p = track.p.rowwise().reverse().eval();
  }
}

}  // namespace depthmocap

#include "libtracker/smooth/look_ahead_smoother.h"

#include <cmath>
#include <numbers>

#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr std::size_t kMostNeighbours = 32;  // on either side, however dense the frames
constexpr double kDistinct = 1e-6;           // shortest basis vector: fewer samples than that make no higher degree

// How much each sample counts in the value at x[centre] = 0 of a quadratic fitted with a triangular kernel to samples
// at x in (-1, 1): basis of polynomials that are orthonormal over the samples.
Eigen::VectorXd fitWeights(const Eigen::VectorXd& x, Eigen::Index centre) {
  const Eigen::VectorXd kernel = 1.0 - x.array().abs();
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(x.size());
  Eigen::MatrixX3d basis(x.size(), 3);
  Eigen::VectorXd p = Eigen::VectorXd::Ones(x.size());
  for (int degree = 0; degree < 3; ++degree) {
    for (int lower = 0; lower < degree; ++lower) {
      p -= basis.col(lower) * basis.col(lower).dot(kernel.cwiseProduct(p));
    }
    const double length = std::sqrt(p.dot(kernel.cwiseProduct(p)));
    if (length < kDistinct) break;
    basis.col(degree) = p / length;
    weights += basis(centre, degree) * kernel.cwiseProduct(basis.col(degree));
    p = x.cwiseProduct(basis.col(degree));
  }
  return weights;
}

// b - a, the heading by the short way round.
Pose change(const Pose& a, const Pose& b) {
  Pose d = b - a;
  d[kRootRy] = std::remainder(d[kRootRy], 2.0 * std::numbers::pi);
  return d;
}

}  // namespace

LookAheadSmoother::LookAheadSmoother(double half_width_s) : half_width_s_(half_width_s) {
  DMC_CHECK(half_width_s >= 0);
}

void LookAheadSmoother::add(const Sample& sample) {
  samples_.push_back(sample);
  for (; due_ > 0 && !reaches(0, due_); --due_) samples_.pop_front();
}

// Whether sample b (> a) is near enough to a to count.
bool LookAheadSmoother::reaches(std::size_t a, std::size_t b) const {
  return b - a <= kMostNeighbours && samples_[b].time_s - samples_[a].time_s < half_width_s_;
}

bool LookAheadSmoother::complete() const {
  if (finished_ || half_width_s_ <= 0) return true;
  for (std::size_t i = due_ + 1; i < samples_.size(); ++i) {
    if (!samples_[i].joined || !reaches(due_, i)) return true;
  }
  return false;
}

Pose LookAheadSmoother::smoothed() const {
  std::size_t first = due_;
  while (first > 0 && samples_[first].joined && reaches(first - 1, due_)) --first;
  std::size_t end = due_ + 1;
  while (end < samples_.size() && samples_[end].joined && reaches(due_, end)) ++end;
  const Sample& centre = samples_[due_];
  Eigen::VectorXd x(static_cast<Eigen::Index>(end - first));
  for (std::size_t i = first; i < end; ++i) {
    x[static_cast<Eigen::Index>(i - first)] = (samples_[i].time_s - centre.time_s) / half_width_s_;
  }
  const Eigen::VectorXd weights = fitWeights(x, static_cast<Eigen::Index>(due_ - first));
  Pose q = centre.q;
  for (std::size_t i = first; i < end; ++i) {
    q += weights[static_cast<Eigen::Index>(i - first)] * change(centre.q, samples_[i].q);
  }
  return q;
}

std::optional<Pose> LookAheadSmoother::next() {
  if (due_ == samples_.size() || !complete()) return std::nullopt;
  const Pose q = half_width_s_ > 0 ? smoothed() : samples_[due_].q;
  ++due_;
  return q;
}

}  // namespace depthmocap

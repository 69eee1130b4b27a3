#include "libtracker/smooth/clip_smoother.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "libtracker/core/check.h"
#include "libtracker/skeleton/block_band.h"
#include "libtracker/skeleton/joint_limits.h"

namespace depthmocap {
namespace {

constexpr std::size_t kMostContext = 60;  // [frames] of context on either side, however dense they are

// Weights of E_smooth between frames of the usual rate; chosen on ten motions (docs/lab/smoothing.md).
constexpr double kLambda = 800.0;           // [1/rad^2] of the joints
constexpr double kLambdaRootTurn = 8000.0;  // [1/rad^2] of heading and tilt: a body turns more steadily than its limbs
constexpr double kLambdaRootPlace = 80000.0;  // [1/m^2] of the root's place
constexpr double kUsualStep_s = 1.0 / 30.0;   // [s] between frames of the usual rate
// Keeps the system regular where a frame says nothing of a DoF and no other frame does.
constexpr double kHold = 1e-3;

// The change of velocity about the middle one of three frames, times the usual step: the second difference of equation
// (5) where the frames come at the usual rate. `weight`: a velocity that wanders has a variance that grows with time.
struct SecondDifference {
  std::array<double, 3> factor;
  Pose weight;  // of each degree of freedom

  SecondDifference(double t0, double t1, double t2) {
    const double before = (t1 - t0) / kUsualStep_s;
    const double after = (t2 - t1) / kUsualStep_s;
    factor = {1.0 / before, -1.0 / before - 1.0 / after, 1.0 / after};
    weight.setConstant(kLambda);
    weight.head<3>().setConstant(kLambdaRootPlace);
    weight.segment<3>(kRootRx).setConstant(kLambdaRootTurn);
    weight *= 2.0 / (before + after);
  }
};

}  // namespace

ClipSmoother::ClipSmoother(double reach_s) : reach_s_(reach_s) {
  DMC_CHECK(reach_s >= 0);
}

void ClipSmoother::add(const Sample& sample) {
  samples_.push_back(sample);
  if (samples_.size() == 1 || !sample.joined) return;
  // Headings without jumps at half turns, so that their differences are those of the body.
  const double before = samples_[samples_.size() - 2].q[kRootRy];
  double& heading = samples_.back().q[kRootRy];
  heading = before + std::remainder(heading - before, 2.0 * std::numbers::pi);
}

std::optional<Pose> ClipSmoother::next() {
  if (solved_.empty()) solvePiece();
  if (solved_.empty()) return std::nullopt;
  Pose q = solved_.front();
  solved_.pop_front();
  ++given_;
  q[kRootRy] = std::remainder(q[kRootRy], 2.0 * std::numbers::pi);
  return q;
}

// The first sample of the context before sample i.
std::size_t ClipSmoother::contextOf(std::size_t i) const {
  std::size_t first = i;
  while (first > 0 && samples_[first].joined && i - first < kMostContext &&
         samples_[i].time_s - samples_[first - 1].time_s <= reach_s_) {
    --first;
  }
  return first;
}

// Solves for the next samples whose context is complete, if those are all of the track or as many as the context.
void ClipSmoother::solvePiece() {
  if (given_ == samples_.size()) return;
  const auto unused = static_cast<std::ptrdiff_t>(contextOf(given_));
  samples_.erase(samples_.begin(), samples_.begin() + unused);
  given_ -= static_cast<std::size_t>(unused);
  std::size_t end = given_ + 1;  // of the track, as far as it is known
  while (end < samples_.size() && samples_[end].joined) ++end;
  std::size_t last = end;  // of those to give, plus one
  if (!finished_ && end == samples_.size() && reach_s_ > 0) {
    last = contextOf(end - 1);
    if (last <= given_ || last - given_ < end - last) return;
  }
  solve(end);
  solved_.resize(last - given_);
}

// The poses of the samples from given_ to `end`, by all held up to there.
void ClipSmoother::solve(std::size_t end) {
  if (reach_s_ <= 0 || end < 3) {
    for (std::size_t i = given_; i < end; ++i) solved_.push_back(samples_[i].q);
    return;
  }
  BlockBand A(end);
  std::vector<Pose> b(end);
  for (std::size_t t = 0; t < end; ++t) {
    const NormalEquations& evidence = samples_[t].evidence;
    A.diagonal[t] = evidence.A.selfadjointView<Eigen::Lower>();
    A.diagonal[t].diagonal().array() += kHold;
    A.back1[t].setZero();
    A.back2[t].setZero();
    b[t] = -evidence.g;
  }
  for (std::size_t t = 2; t < end; ++t) {
    const std::array<const Sample*, 3> three = {&samples_[t - 2], &samples_[t - 1], &samples_[t]};
    const SecondDifference d(three[0]->time_s, three[1]->time_s, three[2]->time_s);
    const Pose now = d.factor[0] * three[0]->q + d.factor[1] * three[1]->q + d.factor[2] * three[2]->q;
    for (std::size_t i = 0; i < 3; ++i) {
      const Pose weighed = d.weight * d.factor[i];
      A.diagonal[t - 2 + i].diagonal() += weighed * d.factor[i];
      b[t - 2 + i] -= weighed.cwiseProduct(now);
    }
    A.back1[t - 1] += d.weight * d.factor[0] * d.factor[1];
    A.back1[t] += d.weight * d.factor[1] * d.factor[2];
    A.back2[t] += d.weight * d.factor[0] * d.factor[2];
  }
  const std::vector<Pose> change = A.solve(b);
  for (std::size_t i = given_; i < end; ++i) {
    const Pose& d = change[i];
    const Pose& q = samples_[i].q;
    solved_.push_back(d.allFinite() ? clampedToLimits(q + d) : q);
  }
}

}  // namespace depthmocap

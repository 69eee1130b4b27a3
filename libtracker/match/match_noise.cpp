#include "libtracker/match/match_noise.h"

#include <algorithm>
#include <cmath>

#include "libtracker/match/lorentzian_weight.h"

namespace depthmocap {
namespace {

constexpr double kOutlier_m = 0.02;  // [m] scale of the Lorentzian that keeps wrong matches from counting as noise
constexpr double kShare = 0.1;       // of the present frame in the running mean: about ten frames count
// Neither a frame of bad fits nor a rendered one without noise may change the weights by more; chosen by hand.
constexpr double kLeastInformation = 0.5;
constexpr double kMostInformation = 6.0;

}  // namespace

void MatchNoise::observe(std::span<const SurfaceMatch> matches, const ForwardKinematics& fk) {
  double sum = 0;
  double total = 0;
  for (const SurfaceMatch& match : matches) {
    const double off = match.n_world.dot(fk.position(match.model) - match.p_world);
    const double weight = lorentzianWeight(off, kOutlier_m);
    sum += weight * off * off;
    total += weight;
  }
  if (total > 0) deviation_m_ += kShare * (std::sqrt(sum / total) - deviation_m_);
}

double MatchNoise::information() const {
  const double ratio = kUsual_m / deviation_m_;
  return std::clamp(ratio * ratio, kLeastInformation, kMostInformation);
}

}  // namespace depthmocap

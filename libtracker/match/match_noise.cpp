#include "libtracker/match/match_noise.h"

#include <algorithm>
#include <cmath>

#include "libtracker/match/lorentzian_weight.h"

namespace depthmocap {
namespace {

constexpr double kOutlier_m = 0.02;  // [m] scale of the Lorentzian that keeps wrong matches from counting as noise
constexpr double kShare = 0.1;       // of the present frame in the running mean: about ten frames count
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
  const double ratio = range_.usual_m / deviation_m_;
  return std::clamp(std::pow(ratio, range_.power), range_.least, range_.most);
}

}  // namespace depthmocap

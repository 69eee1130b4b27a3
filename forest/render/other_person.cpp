#include "forest/render/other_person.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace depthmocap {
namespace {

// [m] the least distance on the floor between the pelvises when one person is moved aside.
double leastGap(const std::vector<Pose>& poses, const std::vector<Pose>& actor, double aside_m) {
  double gap = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < actor.size(); ++i) {
    const Pose& q = poses[std::min(i, poses.size() - 1)];
    gap = std::min(gap, std::hypot(q[kRootTx] + aside_m - actor[i][kRootTx], q[kRootTz] - actor[i][kRootTz]));
  }
  return gap;
}

// [m] how far aside that gap is kept: to both sides in turn, farther and farther; 0 where 2 m do not suffice.
double asideUntilApart(const std::vector<Pose>& poses, const std::vector<Pose>& actor, double apart_m) {
  constexpr double kStep_m = 0.1;
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    const int steps = (i % 2 == 0 ? 1 : -1) * (1 + i / 2);
    const double aside_m = kStep_m * steps;
    if (leastGap(poses, actor, aside_m) >= apart_m) return aside_m;
  }
  return 0;
}

}  // namespace

std::vector<Pose> stageOther(const OtherPerson& other, const StagedMotion& actor) {
  std::vector<Pose> poses = stageMotion(other.clip, other.body, other.staging).poses;
  const double apart = other.apart_m > 0 ? asideUntilApart(poses, actor.poses, other.apart_m) : 0;
  for (Pose& q : poses) q[kRootTx] += other.aside_m + apart;
  return poses;
}

}  // namespace depthmocap

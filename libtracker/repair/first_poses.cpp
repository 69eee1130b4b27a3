#include "libtracker/repair/first_poses.h"

#include <cmath>
#include <numbers>

#include "libtracker/core/parallel.h"

namespace depthmocap {

std::vector<std::size_t> keyframesOf(const std::vector<MarkerView>& views, const std::vector<double>& time_s,
                                     std::size_t least, double apart_s) {
  std::vector<std::size_t> keyframes;
  for (std::size_t t = 0; t < views.size(); ++t) {
    const bool is_far = keyframes.empty() || time_s[t] - time_s[keyframes.back()] >= apart_s - 1e-9;
    if (is_far && views[t].markers.size() >= least) keyframes.push_back(t);
  }
  return keyframes;
}

std::vector<Pose> firstPoses(const IkSolver& solver, const MarkerBody& body, const std::vector<MarkerView>& views,
                             const std::vector<double>& time_s, const std::vector<std::size_t>& keyframes,
                             int threads) {
  std::vector<Pose> keys(keyframes.size());
  parallelFor(threads, keys.size(),
              [&](std::size_t k) { keys[k] = solver.solve(viewTargets(body, views[keyframes[k]])).q; });
  for (std::size_t k = 1; k < keys.size(); ++k) {
    const double turn = std::remainder(keys[k][kRootRy] - keys[k - 1][kRootRy], 2.0 * std::numbers::pi);
    keys[k][kRootRy] = keys[k - 1][kRootRy] + turn;
  }
  std::vector<Pose> poses(views.size());
  std::size_t next = 0;
  for (std::size_t t = 0; t < poses.size(); ++t) {
    while (next < keyframes.size() && keyframes[next] < t) ++next;
    if (next == 0 || next == keyframes.size()) {
      poses[t] = next == 0 ? keys.front() : keys.back();
      continue;
    }
    const double from_s = time_s[keyframes[next - 1]];
    const double share = (time_s[t] - from_s) / (time_s[keyframes[next]] - from_s);
    poses[t] = (1.0 - share) * keys[next - 1] + share * keys[next];
  }
  return poses;
}

}  // namespace depthmocap

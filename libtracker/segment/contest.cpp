#include "libtracker/segment/contest.h"

#include <algorithm>
#include <limits>

#include "libtracker/segment/expected_body.h"

namespace depthmocap {
namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [m] Bodies whose joints are this near each other are in contest.
constexpr double kContest_m = 0.6;
// [m] A body must be nearer than every other one by so much; otherwise memory decides.
constexpr float kNearer_m = 0.06F;

bool inContest(const JointPositions& a, const JointPositions& b) {
  for (int i = 0; i < kJointCount; ++i) {
    if ((b.colwise() - a.col(i)).colwise().squaredNorm().minCoeff() < kContest_m * kContest_m) return true;
  }
  return false;
}

std::vector<ExpectedBody> bodiesInContest(const ExpectedPeople& expected) {
  std::vector<ExpectedBody> bodies;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (!expected[i] || !expected[i]->joints_camera) continue;
    const bool near_another = std::ranges::any_of(expected, [&](const std::optional<ExpectedActor>& other) {
      return other && other->joints_camera && &other != &expected[i] &&
             inContest(*expected[i]->joints_camera, *other->joints_camera);
    });
    if (near_another) bodies.emplace_back(static_cast<Identity>(i + 1), *expected[i]->joints_camera);
  }
  return bodies;
}

}  // namespace

void settleContest(const CoarseCloud& cloud, const ExpectedPeople& expected, std::vector<Identity>& known) {
  const std::vector<ExpectedBody> bodies = bodiesInContest(expected);
  if (bodies.empty()) return;
  const auto isTheirs = [&](Identity who) {
    return who == kUnknown || std::ranges::any_of(bodies, [&](const ExpectedBody& body) { return body.who() == who; });
  };
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    if (p.z() <= 0 || !isTheirs(known[i])) continue;
    float least = std::numeric_limits<float>::max();
    float second = least;
    Identity nearest = kUnknown;
    for (const ExpectedBody& body : bodies) {
      const float distance = body.distance(p);
      if (distance < least) {
        second = least;
        least = distance;
        nearest = body.who();
      } else {
        second = std::min(second, distance);
      }
    }
    if (least < ExpectedBody::kFarthest_m && least + kNearer_m < second) known[i] = nearest;
  }
}

}  // namespace depthmocap

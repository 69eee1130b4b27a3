#include "libtracker/segment/contest.h"

#include <algorithm>
#include <limits>

#include "libtracker/core/stick_figure.h"

namespace depthmocap {
namespace {

// Chosen by hand: no comparison of values is on record (docs/tuning.md).

// [m] Bodies whose joints are this near each other are in contest.
constexpr double kContest_m = 0.6;
// [m] Farthest from the lines between a body's joints that its surface is.
constexpr float kBody_m = 0.20F;
// [m] A body must be nearer than every other one by so much; otherwise memory decides.
constexpr float kNearer_m = 0.06F;

float distanceToLine(const Eigen::Vector3f& p, const Eigen::Vector3f& from, const Eigen::Vector3f& to) {
  const Eigen::Vector3f along = to - from;
  const float square = along.squaredNorm();
  const float share = square > 0 ? std::clamp(along.dot(p - from) / square, 0.0F, 1.0F) : 0.0F;
  return (p - from - share * along).norm();
}

struct Body {
  Identity who;
  Eigen::Matrix<float, 3, kJointCount> joints;  // [m] camera
  Eigen::Vector3f low, high;                    // [m] what its surface lies within

  Body(Identity number, const JointPositions& p_camera)
      : who(number),
        joints(p_camera.cast<float>()),
        low(joints.rowwise().minCoeff().array() - kBody_m),
        high(joints.rowwise().maxCoeff().array() + kBody_m) {}

  [[nodiscard]] float distance(const Eigen::Vector3f& p) const {
    if ((p.array() < low.array()).any() || (p.array() > high.array()).any()) return std::numeric_limits<float>::max();
    float least = std::numeric_limits<float>::max();
    for (const BoneLine& line : kBoneLines) {
      const float distance =
          distanceToLine(p, joints.col(static_cast<int>(line.from)), joints.col(static_cast<int>(line.to)));
      least = std::min(least, distance);
    }
    return least;
  }
};

bool inContest(const JointPositions& a, const JointPositions& b) {
  for (int i = 0; i < kJointCount; ++i) {
    if ((b.colwise() - a.col(i)).colwise().squaredNorm().minCoeff() < kContest_m * kContest_m) return true;
  }
  return false;
}

std::vector<Body> bodiesInContest(const ExpectedPeople& expected) {
  std::vector<Body> bodies;
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
  const std::vector<Body> bodies = bodiesInContest(expected);
  if (bodies.empty()) return;
  const auto isTheirs = [&](Identity who) {
    return who == kUnknown || std::ranges::any_of(bodies, [&](const Body& body) { return body.who == who; });
  };
  for (std::size_t i = 0; i < known.size(); ++i) {
    const Eigen::Vector3f& p = cloud.points[i];
    if (p.z() <= 0 || !isTheirs(known[i])) continue;
    float least = std::numeric_limits<float>::max();
    float second = least;
    Identity nearest = kUnknown;
    for (const Body& body : bodies) {
      const float distance = body.distance(p);
      if (distance < least) {
        second = least;
        least = distance;
        nearest = body.who;
      } else {
        second = std::min(second, distance);
      }
    }
    if (least < kBody_m && least + kNearer_m < second) known[i] = nearest;
  }
}

}  // namespace depthmocap

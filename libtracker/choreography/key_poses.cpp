#include "libtracker/choreography/key_poses.h"

#include <algorithm>
#include <cmath>

#include "libtracker/choreography/easing.h"
#include "libtracker/core/check.h"

namespace depthmocap {
namespace {

constexpr double kArmLag = 0.05;         // [s] the arms follow the trunk
constexpr double kStepLiftShare = 0.22;  // a step lifts the foot by this share of its length
constexpr double kMinStepLift = 0.035;   // [m]
constexpr double kMaxStepLift = 0.10;    // [m]
constexpr double kStepPitch = 0.35;      // [rad] the heel leaves the floor first
constexpr double kStepDistance = 0.015;  // [m] below this a foot's change of place is no step
constexpr double kStepTurn = 0.08;       // [rad]

FootState footState(const FootKey& key, Side side, double heel_rise) {
  FootState foot;
  foot.x = sideSign(side) * key.out;
  foot.z = key.forward;
  foot.ground = key.ground;
  foot.lift = key.lift;
  foot.pitch = key.pitch;
  foot.heading = sideSign(side) * key.toe_out;
  foot.heel_rise = heel_rise;
  foot.knee_out = key.knee_out;
  return foot;
}

void vary(HandTarget& hand, double spread, Random& random) {
  hand.out += spread * random.normal();
  hand.up += spread * random.normal();
  hand.forward += spread * random.normal();
  hand.elbow += 2.0 * spread * random.normal();
}

BodyFrame frameOfKey(const Skeleton& skeleton, const KeyPose& key, const Performance& performance, Random& random) {
  BodyFrame frame;
  frame.pelvis = key.pelvis;
  frame.spine = key.spine;
  frame.head = key.head;
  for (double* angle : {&frame.spine.bend, &frame.spine.twist, &frame.spine.side, &frame.head.nod, &frame.head.turn}) {
    *angle += performance.angle_spread * random.normal();
  }
  HandTarget left = key.left;
  HandTarget right = key.right;
  vary(left, performance.hand_spread, random);
  vary(right, performance.hand_spread, random);
  frame.left_arm = reachArm(skeleton, left);
  frame.right_arm = reachArm(skeleton, right);
  frame.left_foot = footState(key.left_foot, Side::Left, performance.heel_rise);
  frame.right_foot = footState(key.right_foot, Side::Right, performance.heel_rise);
  return frame;
}

// At the ends the spline rests.
std::vector<FrameChannels> shapePreservingSlopes(const std::vector<double>& time,
                                                 const std::vector<FrameChannels>& value) {
  const std::size_t n = time.size();
  std::vector<FrameChannels> slope(n, FrameChannels::Zero());
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double before = time[k] - time[k - 1];
    const double after = time[k + 1] - time[k];
    const FrameChannels d0 = (value[k] - value[k - 1]) / before;
    const FrameChannels d1 = (value[k + 1] - value[k]) / after;
    for (int c = 0; c < kFrameChannels; ++c) slope[k][c] = shapePreservingSlope(d0[c], d1[c], before, after);
  }
  return slope;
}

class FrameSpline {
 public:
  FrameSpline(std::vector<double> time, std::vector<FrameChannels> value)
      : time_(std::move(time)), value_(std::move(value)), slope_(shapePreservingSlopes(time_, value_)) {}

  [[nodiscard]] std::size_t interval(double t) const {
    const auto next = std::upper_bound(time_.begin(), time_.end(), t);
    const auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, next - time_.begin() - 1));
    return std::min(k, time_.size() - 2);
  }
  [[nodiscard]] double share(double t) const {
    const std::size_t k = interval(t);
    return std::clamp((t - time_[k]) / (time_[k + 1] - time_[k]), 0.0, 1.0);
  }
  [[nodiscard]] FrameChannels at(double t) const {
    const std::size_t k = interval(t);
    const HermiteWeights w = hermiteWeights(share(t), time_[k + 1] - time_[k]);
    return w.a * value_[k] + w.b * slope_[k] + w.c * value_[k + 1] + w.d * slope_[k + 1];
  }

 private:
  std::vector<double> time_;
  std::vector<FrameChannels> value_, slope_;
};

bool isLifted(const FootState& from, const FootState& to) {
  return std::max(from.lift, to.lift) > kStepDistance;
}

bool isStep(const FootState& from, const FootState& to) {
  const bool moves = std::hypot(to.x - from.x, to.z - from.z) > kStepDistance;
  const bool turns = std::abs(to.heading - from.heading) > kStepTurn;
  const bool rises = std::abs(to.ground - from.ground) > kStepDistance;
  return !isLifted(from, to) && (moves || turns || rises);
}

// A foot on its way from one standing place to the next; share [0, 1] of the step. A foot that has to carry the body
// meanwhile turns on the spot.
void takeStep(const FootState& from, const FootState& to, double share, bool carries, FootState& foot) {
  const double u = minimumJerk(share);
  foot.x = lerp(from.x, to.x, u);
  foot.z = lerp(from.z, to.z, u);
  foot.ground = lerp(from.ground, to.ground, u);
  foot.heading = lerp(from.heading, to.heading, u);
  if (carries) return;
  const double distance = std::hypot(to.x - from.x, to.z - from.z);
  foot.lift += std::clamp(kStepLiftShare * distance, kMinStepLift, kMaxStepLift) * bump(share);
  foot.pitch += kStepPitch * bump(1.4 * share);
}

void takeSteps(const BodyFrame& from, const BodyFrame& to, double share, bool hops, BodyFrame& frame) {
  const bool left = isStep(from.left_foot, to.left_foot);
  const bool right = isStep(from.right_foot, to.right_foot);
  const bool one_by_one = left && right && !hops;
  const double first = one_by_one ? 2.0 * share : share;
  const double second = one_by_one ? 2.0 * share - 1.0 : share;
  if (left) {
    takeStep(from.left_foot, to.left_foot, std::min(1.0, first), isLifted(from.right_foot, to.right_foot),
             frame.left_foot);
  }
  if (right) {
    takeStep(from.right_foot, to.right_foot, std::max(0.0, second), isLifted(from.left_foot, to.left_foot),
             frame.right_foot);
  }
}

}  // namespace

KeyPose& KeySequence::add(const KeyPose& pose, double after_s) {
  DMC_CHECK(keys_.empty() ? after_s >= 0 : after_s > 0);
  const double time_s = end() + after_s;
  keys_.push_back(pose);
  keys_.back().time_s = time_s;
  return keys_.back();
}

KeyPose& KeySequence::last() {
  DMC_CHECK(!keys_.empty());
  return keys_.back();
}

BodyFrames playKeys(const Skeleton& skeleton, const KeySequence& sequence, const Performance& performance,
                    Random& random) {
  DMC_CHECK(sequence.keys().size() >= 2);
  std::vector<double> time;
  std::vector<FrameChannels> value;
  for (const KeyPose& key : sequence.keys()) {
    time.push_back(key.time_s / performance.tempo);
    value.push_back(channelsOf(frameOfKey(skeleton, key, performance, random)));
  }
  const double duration = time.back();
  const FrameSpline spline(time, value);
  BodyFrames frames;
  for (int i = 0; i / kMotionFps <= duration; ++i) {
    const double t = i / kMotionFps;
    FrameChannels channels = spline.at(t);
    channels.segment<kArmChannels>(kTrunkChannels) =
        spline.at(std::max(0.0, t - kArmLag)).segment<kArmChannels>(kTrunkChannels);
    BodyFrame frame = frameOf(channels);
    const std::size_t k = spline.interval(t);
    const BodyFrame from = frameOf(value[k]);
    const BodyFrame to = frameOf(value[k + 1]);
    takeSteps(from, to, spline.share(t), performance.hops, frame);
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace depthmocap

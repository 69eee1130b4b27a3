#include "libtracker/tracker/foot_watch.h"

#include <algorithm>
#include <limits>

namespace depthmocap {
namespace {

// Chosen on rendered motions that are in no accuracy figure (docs/lab/smoothing.md, "Feet that stand").
constexpr double kRestSpeed_m_s = 0.25;  // the noise of a foot that rests stays below it
constexpr double kDownHeight_m = 0.06;   // above where the point is in a standing body
constexpr double kUpHeight_m = 0.10;
constexpr double kUpDistance_m = 0.03;  // from the place where it was put down
constexpr double kDrift_s = 0.2;        // time constant with which that place follows the poses
constexpr double kFirstWeight = 0.2;    // a step of a runner is too short to be sure of;
constexpr double kTrust_s = 0.4;        // the weight grows by 1 in this time

struct Sole {
  BonePoint point;
  double height_m;  // above the floor where the actor stands
};

std::array<Sole, kFootPointCount> solesOf(const Skeleton& s) {
  const double ankle_m = ankleHeight(s.lengths);
  const Eigen::Vector3d ankle = Eigen::Vector3d::Zero();
  return {{{{Bone::LeftFoot, ankle}, ankle_m},
           {{Bone::LeftFoot, s.left_toe}, ankle_m + s.left_toe.y()},
           {{Bone::RightFoot, ankle}, ankle_m},
           {{Bone::RightFoot, s.right_toe}, ankle_m + s.right_toe.y()}}};
}

}  // namespace

void FootWatch::Track::add(const Place& place) {
  std::rotate(last.begin(), last.end() - 1, last.end());
  last[0] = place;
  seen = std::min(seen + 1, kFrames);
}

// Between the means of two frames each: a single one is noisy.
bool FootWatch::Track::rests() const {
  if (seen < kFrames) return false;
  const Eigen::Vector3d way = last[0].p_world + last[1].p_world - last[kFrames - 2].p_world - last[kFrames - 1].p_world;
  const double span_s = last[0].time_s + last[1].time_s - last[kFrames - 2].time_s - last[kFrames - 1].time_s;
  return way.norm() < kRestSpeed_m_s * span_s;
}

void FootWatch::reset() {
  tracks_ = {};
  contacts_ = {};
}

void FootWatch::observe(const Skeleton& skeleton, const Pose& q, double time_s,
                        const std::optional<Eigen::Vector4d>& floor_world) {
  const auto soles = solesOf(skeleton);
  ForwardKinematics fk;
  fk.update(skeleton, q);
  double lowest = std::numeric_limits<double>::max();
  for (const Sole& sole : soles) lowest = std::min(lowest, fk.position(sole.point).y() - sole.height_m);
  const double level = floor_height_.follow(lowest, time_s);
  const Eigen::Vector4d floor = floor_world.value_or(Eigen::Vector4d(0, 1, 0, -level));
  for (std::size_t i = 0; i < soles.size(); ++i) {
    const Eigen::Vector3d p = fk.position(soles[i].point);
    tracks_[i].add({time_s, p});
    contacts_[i].point = soles[i].point;
    const double height_m = floor.head<3>().dot(p) + floor[3] - soles[i].height_m;
    putDownOrLift(tracks_[i], height_m, std::max(0.0, time_s - time_s_), contacts_[i]);
  }
  time_s_ = time_s;
}

void FootWatch::putDownOrLift(Track& track, double height_m, double dt_s, FootContact& contact) {
  const Eigen::Vector3d& p_world = track.last[0].p_world;
  if (contact.weight > 0) {
    const Eigen::Vector3d away = p_world - contact.p_world;
    contact.p_world += away * dt_s / (dt_s + kDrift_s);
    contact.weight = std::min(1.0, contact.weight + dt_s / kTrust_s);
    if (away.norm() < kUpDistance_m && height_m < kUpHeight_m) return;
    contact.weight = 0;
    track.seen = 1;  // it has to rest anew
  } else if (track.rests() && height_m < kDownHeight_m) {
    contact.weight = kFirstWeight;
    contact.p_world = 0.5 * (p_world + track.last[1].p_world);
  }
}

}  // namespace depthmocap

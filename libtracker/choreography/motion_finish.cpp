#include "libtracker/choreography/motion_finish.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "libtracker/choreography/body_solver.h"

namespace depthmocap {
namespace {

constexpr int kBalanceSmoothing = 7;    // [frames] people shift their weight before they lift a foot
constexpr int kHeightWindow = 3;        // [frames]
constexpr double kBalanceShare = 0.75;  // of the way to perfect balance, twice
constexpr double kCarryingLift = 0.05;  // [m] a foot lifted this far carries nothing
constexpr double kFootCenter = 0.045;   // [m] middle of the foot before the ankle

// A slow random drift: three sines.
class Drift {
 public:
  Drift(Random& random, double amplitude) {
    for (auto& part : parts_) {
      part = {amplitude * random.uniform(0.3, 0.9), random.uniform(0.12, 0.75), random.uniform(0.0, 1.0)};
    }
  }
  [[nodiscard]] double at(double time_s) const {
    double sum = 0;
    for (const auto& part : parts_) {
      sum += part.amplitude * std::sin(2 * std::numbers::pi * (part.frequency_hz * time_s + part.phase));
    }
    return sum;
  }

 private:
  struct Part {
    double amplitude, frequency_hz, phase;
  };
  std::array<Part, 3> parts_;
};

// Typical unsteadiness of each trunk and arm channel, in the order of channelsOf(): [m] and [rad].
constexpr std::array<double, kTrunkChannels + kArmChannels> kUnsteadiness = {
    0.006, 0.006, 0.0,   0.012, 0.008, 0.006, 0.0,  // pelvis x z y heading lean tilt
    0.015, 0.018, 0.010,                            // spine
    0.025, 0.015, 0.040,                            // head
    0.010, 0.010, 0.025, 0.020, 0.020, 0.030,       // left arm
    0.010, 0.010, 0.025, 0.020, 0.020, 0.030};      // right arm

void addNaturalNoise(BodyFrames& frames, double liveliness, Random& random) {
  std::vector<Drift> drifts;
  drifts.reserve(kUnsteadiness.size());
  for (const double amplitude : kUnsteadiness) drifts.emplace_back(random, liveliness * amplitude);
  for (std::size_t t = 0; t < frames.size(); ++t) {
    FrameChannels channels = channelsOf(frames[t]);
    for (std::size_t c = 0; c < drifts.size(); ++c) {
      channels[static_cast<int>(c)] += drifts[c].at(static_cast<double>(t) / kMotionFps);
    }
    frames[t] = frameOf(channels);
  }
}

// Moving average over +-radius frames, three times: nearly a Gaussian. The ends repeat.
void smooth(std::vector<double>& values, int radius) {
  const int n = static_cast<int>(values.size());
  for (int pass = 0; pass < 3; ++pass) {
    const std::vector<double> from = values;
    for (int t = 0; t < n; ++t) {
      double sum = 0;
      for (int k = -radius; k <= radius; ++k) sum += from[static_cast<std::size_t>(std::clamp(t + k, 0, n - 1))];
      values[static_cast<std::size_t>(t)] = sum / (2 * radius + 1);
    }
  }
}

// Where the feet carry the body: the middle of the loaded feet.
Eigen::Vector2d supportCenter(const BodyFrame& frame) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double weight = 0;
  for (const FootState& foot : {frame.left_foot, frame.right_foot}) {
    const double load = 0.001 + std::clamp(1.0 - foot.lift / kCarryingLift, 0.0, 1.0);
    sum += load * Eigen::Vector2d(foot.x + kFootCenter * std::sin(foot.heading),
                                  foot.z + kFootCenter * std::cos(foot.heading));
    weight += load;
  }
  return sum / weight;
}

void keepBalance(const Skeleton& skeleton, BodyFrames& frames) {
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<double> dx, dz;
    for (const BodyFrame& frame : frames) {
      const Eigen::Vector3d center = centerOfMass(skeleton, solveBody(skeleton, frame));
      const Eigen::Vector2d support = supportCenter(frame);
      dx.push_back(kBalanceShare * (1.0 - frame.pelvis.held) * (support.x() - center.x()));
      dz.push_back(kBalanceShare * (1.0 - frame.pelvis.held) * (support.y() - center.z()));
    }
    smooth(dx, kBalanceSmoothing / 2);
    smooth(dz, kBalanceSmoothing / 2);
    for (std::size_t t = 0; t < frames.size(); ++t) {
      frames[t].pelvis.x += dx[t];
      frames[t].pelvis.z += dz[t];
    }
  }
}

// pelvis.y at most what the legs allow: the lower envelope over a window, smoothed, so that the pelvis never jerks.
void limitPelvisHeight(const Skeleton& skeleton, BodyFrames& frames) {
  const int n = static_cast<int>(frames.size());
  std::vector<double> excess;
  for (const BodyFrame& frame : frames)
    excess.push_back(std::max(0.0, frame.pelvis.y - highestPelvis(skeleton, frame)));
  std::vector<double> drop(excess.size());
  for (int t = 0; t < n; ++t) {
    for (int k = -kHeightWindow; k <= kHeightWindow; ++k) {
      drop[static_cast<std::size_t>(t)] =
          std::max(drop[static_cast<std::size_t>(t)], excess[static_cast<std::size_t>(std::clamp(t + k, 0, n - 1))]);
    }
  }
  smooth(drop, kHeightWindow / 3);
  for (std::size_t t = 0; t < frames.size(); ++t) frames[t].pelvis.y -= drop[t];
}

}  // namespace

std::vector<Pose> finishMotion(const Skeleton& skeleton, RawMotion motion, Random& random) {
  addNaturalNoise(motion.frames, motion.liveliness, random);
  keepBalance(skeleton, motion.frames);
  limitPelvisHeight(skeleton, motion.frames);
  std::vector<Pose> poses;
  poses.reserve(motion.frames.size());
  for (const BodyFrame& frame : motion.frames) poses.push_back(solveBody(skeleton, frame));
  return poses;
}

}  // namespace depthmocap

#include "libtracker/classify/side_expectation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "depthmocap/parts.h"
#include "libtracker/core/parallel.h"

namespace depthmocap {
namespace {

constexpr std::size_t kPixelsPerTask = 1024;
constexpr float kSideSigma_m = 0.10F;     // how far from its expected bone a pixel may well lie
constexpr float kSurpriseShare = 0.1F;    // weight of a side whose bone is expected far away: the classifier can win
constexpr float kMinProbability = 0.05F;  // of both sides together; less does not make a marker

struct Bones {
  Part left;
  Joint left_from, left_to, right_from, right_to;
};
constexpr std::array<Bones, 4> kLimbs = {{
    {Part::LeftUpperArm, Joint::LeftShoulder, Joint::LeftElbow, Joint::RightShoulder, Joint::RightElbow},
    {Part::LeftLowerArm, Joint::LeftElbow, Joint::LeftWrist, Joint::RightElbow, Joint::RightWrist},
    {Part::LeftUpperLeg, Joint::LeftHip, Joint::LeftKnee, Joint::RightHip, Joint::RightKnee},
    {Part::LeftLowerLeg, Joint::LeftKnee, Joint::LeftAnkle, Joint::RightKnee, Joint::RightAnkle},
}};

struct Segment {
  Eigen::Vector3f from;
  Eigen::Vector3f along;
  float inverse_square = 0;  // of its length

  [[nodiscard]] float squaredDistance(const Eigen::Vector3f& p) const {
    const float share = std::clamp((p - from).dot(along) * inverse_square, 0.0F, 1.0F);
    return (p - from - share * along).squaredNorm();
  }
};

Segment segment(const JointPositions& joints, Joint from, Joint to) {
  Segment s;
  s.from = joints.col(static_cast<int>(from)).cast<float>();
  s.along = joints.col(static_cast<int>(to)).cast<float>() - s.from;
  s.inverse_square = 1.0F / std::max(s.along.squaredNorm(), 1e-6F);
  return s;
}

}  // namespace

void expectSides(const JointPositions& joints_camera, const CameraModel& camera, int threads,
                 ClassifiedPixels& pixels) {
  std::array<std::array<Segment, 2>, kLimbs.size()> limbs;
  for (std::size_t i = 0; i < kLimbs.size(); ++i) {
    limbs[i] = {segment(joints_camera, kLimbs[i].left_from, kLimbs[i].left_to),
                segment(joints_camera, kLimbs[i].right_from, kLimbs[i].right_to)};
  }
  const float per_d = 0.5F / (kSideSigma_m * kSideSigma_m);
  const auto weight = [&](const Segment& s, const Eigen::Vector3f& p) {
    return kSurpriseShare + std::exp(-per_d * s.squaredDistance(p));
  };
  const std::size_t count = pixels.pixels.size();
  parallelFor(threads, (count + kPixelsPerTask - 1) / kPixelsPerTask, [&](std::size_t task) {
    for (std::size_t n = task * kPixelsPerTask; n < std::min(count, (task + 1) * kPixelsPerTask); ++n) {
      auto& pixel = pixels.pixels[n];
      const Eigen::Vector3f p = camera.unproject(pixel.x, pixel.y, static_cast<double>(pixel.depth_m)).cast<float>();
      for (std::size_t i = 0; i < kLimbs.size(); ++i) {
        float& left = pixel.probability[static_cast<std::size_t>(partIndex(kLimbs[i].left))];
        float& right = pixel.probability[static_cast<std::size_t>(partIndex(mirrored(kLimbs[i].left)))];
        const float both = left + right;
        if (both < kMinProbability) continue;
        const float l = left * weight(limbs[i][0], p);
        const float r = right * weight(limbs[i][1], p);
        left = both * l / (l + r);
        right = both - left;
      }
    }
  });
}

}  // namespace depthmocap

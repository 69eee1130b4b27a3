#include "libtracker/motion/mirrored_sides.h"

#include <cmath>
#include <cstddef>

namespace depthmocap {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kMostFrames = 300;  // looked at, spread over the motion
constexpr double kLeastToes = 0.3;        // mean cosine of toes and front: people have 0.6 and more, either way
constexpr double kLeastKnees = 0.02;      // mean way of the knee out of the leg's line, of the thigh's length

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

// Means over frames and legs, positive towards the front that the names of the sides say.
class Front {
 public:
  void add(const GlobalFrame& frame, const NamedBones& named) {
    const auto p = [&](int bone) -> const Vector3d& { return frame.position[at(bone)]; };
    const Vector3d across = p(named.left.femur) - p(named.right.femur);
    const Vector3d trunk =
        0.5 * (p(named.left.humerus) + p(named.right.humerus) - p(named.left.femur) - p(named.right.femur));
    const Vector3d thighs = p(named.left.tibia) + p(named.right.tibia) - p(named.left.femur) - p(named.right.femur);
    // Also somebody who sits or bends over has one of the two upright.
    const Vector3d forward = across.cross(trunk.normalized() - thighs.normalized()).normalized();
    for (const NamedBones::Side* side : {&named.left, &named.right}) {
      if (side->foot < 0) continue;
      const Vector3d leg = (p(side->foot) - p(side->femur)).normalized();
      const Vector3d thigh = p(side->tibia) - p(side->femur);
      knees_ += forward.dot(thigh - leg * leg.dot(thigh)) / thigh.norm();
      ++legs_;
      if (side->toe < 0) continue;
      toes_ += forward.dot((p(side->toe) - p(side->foot)).normalized());
      ++feet_;
    }
  }
  // Knees and toes must agree, as far as knees bend and feet have toes: a toe alone may point anywhere.
  [[nodiscard]] bool isBehind() const {
    const bool bend = std::abs(knees_) > kLeastKnees * legs_;
    if (feet_ > 0 && !(toes_ < -kLeastToes * feet_)) return false;
    return bend ? knees_ < 0 : feet_ > 0;
  }

 private:
  double knees_ = 0;
  double toes_ = 0;
  int legs_ = 0;
  int feet_ = 0;
};

}  // namespace

bool sidesAreMirrored(const SourceMotion& motion, const NamedBones& named) {
  Front front;
  GlobalFrame frame;
  const std::size_t step = 1 + motion.frames.size() / kMostFrames;
  for (std::size_t f = 0; f < motion.frames.size(); f += step) {
    globalFrame(motion.bones, motion.frames[f], frame);
    front.add(frame, named);
  }
  return front.isBehind();
}

}  // namespace depthmocap

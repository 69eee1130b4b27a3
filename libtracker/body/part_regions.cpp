#include "libtracker/body/part_regions.h"

#include <algorithm>
#include <cmath>

namespace depthmocap {
namespace {

// Heights of the joints above the root and distances from the middle plane, zero pose [m].
struct Landmarks {
  double hip_y, knee_y, waist_top_y, shoulder_x, shoulder_y, neck_y, head_y;
  explicit Landmarks(const BoneLengths& l)
      : hip_y(-l.hip_drop),
        knee_y(-l.hip_drop - l.upper_leg),
        waist_top_y(0.60 * l.spine),
        shoulder_x(0.5 * l.shoulder_width),
        shoulder_y(l.torso - l.shoulder_drop),
        neck_y(l.torso),
        head_y(l.torso + l.neck_to_head) {}
};

double ramp(double from, double to, double value) {
  return std::clamp((value - from) / (to - from), 0.0, 1.0);
}

// Right-hand result for a point with x <= 0 mirrored to x >= 0; the caller turns it to the left.
Part rightPartOf(const BoneLengths& l, double x, double y, double z) {
  const Landmarks at(l);
  // Arms: beyond the body's side, at arm height.
  if (x > at.shoulder_x + 0.25 * l.upper_arm && y > at.shoulder_y - 0.45 * l.upper_arm) {
    return x > at.shoulder_x + l.upper_arm ? Part::RightLowerArm : Part::RightUpperArm;
  }
  // Jaw line: chin in front, base of the skull behind.
  if (y > at.head_y - 0.50 * l.neck_to_head - 0.35 * z) return Part::Head;
  // Base of the neck: falls from the sides to the notch of the breast bone, ends on the slope of the trapezius.
  const double neck_base = at.neck_y - 0.10 * l.neck_to_head + 0.25 * std::max(0.0, x - 0.2 * at.shoulder_x);
  if (y > neck_base && x < 0.52 * at.shoulder_x) return Part::Neck;
  // The line from the middle of the clavicle to the armpit.
  const double armpit_y = at.shoulder_y - 0.38 * l.upper_arm;
  const double line = ramp(at.shoulder_y + 0.12 * l.upper_arm, armpit_y, y);
  if (y > armpit_y && x > at.shoulder_x * (0.50 + 0.50 * line)) return Part::RightShoulder;
  if (y > at.waist_top_y) return Part::Torso;
  // The crease of the leg rises outwards in front; behind it is the fold under the buttock, nearly level.
  const double front = ramp(-0.14 * l.upper_leg, 0.12 * l.upper_leg, z);
  const double crease = at.hip_y - 0.19 * l.upper_leg + (0.30 + 0.42 * front) * x;
  if (y > crease) return Part::RightWaist;
  return y > at.knee_y ? Part::RightUpperLeg : Part::RightLowerLeg;
}

}  // namespace

Part partOfPoint(const Skeleton& skeleton, const Eigen::Vector3f& p) {
  const Part right = rightPartOf(skeleton.lengths, std::abs(p.x()), p.y(), p.z());
  return p.x() > 0 ? mirrored(right) : right;
}

void labelParts(BodySurface& body) {
  body.part.resize(body.triangles.size());
  for (std::size_t i = 0; i < body.triangles.size(); ++i) {
    const auto& t = body.triangles[i];
    const Eigen::Vector3f center = (body.vertices[t[0]] + body.vertices[t[1]] + body.vertices[t[2]]) / 3.0F;
    body.part[i] = static_cast<std::uint8_t>(partOfPoint(body.skeleton, center));
  }
}

}  // namespace depthmocap

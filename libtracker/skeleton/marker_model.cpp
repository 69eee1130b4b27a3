#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {

// Offsets along a bone are shares of its length, all others [m] on the average body (statureOf(BoneLengths{})). They
// and the radii are the least-squares fit of `forest markers` over rendered bodies: MeanShift mode + radius * viewing
// ray.
MarkerModel averageMarkerModel(const Skeleton& s) {
  const BoneLengths& l = s.lengths;
  const double scale = statureOf(l) / statureOf(BoneLengths{});
  MarkerModel model;
  const auto set = [&](Part part, Bone bone, double x, double y, double z) {
    model[static_cast<std::size_t>(partIndex(part))] = {bone, Eigen::Vector3d(x, y, z)};
  };
  set(Part::Head, Bone::Head, 0, 1.06 * s.head_center.y(), 0.015 * scale);
  set(Part::Neck, Bone::Neck, 0, 0.22 * l.neck_to_head, -0.011 * scale);
  set(Part::Torso, Bone::UpperBack, 0, 0.297 * (l.torso - l.spine), 0.009 * scale);
  const auto side = [&](double sign, bool left) {
    const Bone humerus = left ? Bone::LeftHumerus : Bone::RightHumerus;
    set(left ? Part::LeftShoulder : Part::RightShoulder, left ? Bone::LeftClavicle : Bone::RightClavicle,
        0.907 * s.offset[static_cast<std::size_t>(humerus)].x(), -0.026 * scale, 0.003 * scale);
    set(left ? Part::LeftUpperArm : Part::RightUpperArm, humerus, sign * 0.608 * l.upper_arm, 0.004 * scale,
        0.002 * scale);
    set(left ? Part::LeftLowerArm : Part::RightLowerArm, left ? Bone::LeftRadius : Bone::RightRadius,
        sign * 0.436 * l.lower_arm, 0, 0);
    set(left ? Part::LeftWaist : Part::RightWaist, Bone::Root, sign * 0.470 * l.hip_width, 0.013 * scale,
        0.004 * scale);
    set(left ? Part::LeftUpperLeg : Part::RightUpperLeg, left ? Bone::LeftFemur : Bone::RightFemur,
        sign * 0.005 * scale, -0.495 * l.upper_leg, 0.003 * scale);
    set(left ? Part::LeftLowerLeg : Part::RightLowerLeg, left ? Bone::LeftTibia : Bone::RightTibia, 0,
        -0.437 * l.lower_leg, -0.005 * scale);
  };
  side(1.0, true);
  side(-1.0, false);
  return model;
}

std::array<double, kPartCount> averagePartRadii(const Skeleton& s) {
  const double scale = statureOf(s.lengths) / statureOf(BoneLengths{});
  std::array<double, kPartCount> radii{0.074, 0.064, 0.059, 0.059, 0.031, 0.031, 0.034, 0.034,
                                       0.112, 0.102, 0.102, 0.074, 0.074, 0.045, 0.045};
  for (double& r : radii) r *= scale;
  return radii;
}

}  // namespace depthmocap

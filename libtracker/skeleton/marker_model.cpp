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
  set(Part::Head, Bone::Head, 0, 1.087 * s.head_center.y(), 0.015 * scale);
  set(Part::Neck, Bone::Neck, 0, 0.20 * l.neck_to_head, -0.013 * scale);
  set(Part::Torso, Bone::UpperBack, 0, 0.294 * (l.torso - l.spine), 0.011 * scale);
  const auto side = [&](double sign, bool left) {
    const Bone humerus = left ? Bone::LeftHumerus : Bone::RightHumerus;
    set(left ? Part::LeftShoulder : Part::RightShoulder, left ? Bone::LeftClavicle : Bone::RightClavicle,
        0.896 * s.offset[static_cast<std::size_t>(humerus)].x(), -0.027 * scale, 0.005 * scale);
    set(left ? Part::LeftUpperArm : Part::RightUpperArm, humerus, sign * 0.589 * l.upper_arm, 0.004 * scale,
        0.002 * scale);
    set(left ? Part::LeftLowerArm : Part::RightLowerArm, left ? Bone::LeftRadius : Bone::RightRadius,
        sign * 0.758 * l.lower_arm, -0.004 * scale, 0.003 * scale);
    set(left ? Part::LeftWaist : Part::RightWaist, Bone::Root, sign * 0.468 * l.hip_width, 0.013 * scale,
        0.005 * scale);
    set(left ? Part::LeftUpperLeg : Part::RightUpperLeg, left ? Bone::LeftFemur : Bone::RightFemur,
        sign * 0.006 * scale, -0.494 * l.upper_leg, 0.001 * scale);
    set(left ? Part::LeftLowerLeg : Part::RightLowerLeg, left ? Bone::LeftTibia : Bone::RightTibia, 0,
        -0.630 * l.lower_leg, 0.016 * scale);
  };
  side(1.0, true);
  side(-1.0, false);
  return model;
}

std::array<double, kPartCount> averagePartRadii(const Skeleton& s) {
  const double scale = statureOf(s.lengths) / statureOf(BoneLengths{});
  std::array<double, kPartCount> radii{0.074, 0.063, 0.057, 0.057, 0.029, 0.029, 0.028, 0.028,
                                       0.109, 0.099, 0.099, 0.072, 0.072, 0.040, 0.040};
  for (double& r : radii) r *= scale;
  return radii;
}

}  // namespace depthmocap

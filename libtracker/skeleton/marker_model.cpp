#include "libtracker/skeleton/marker_model.h"

namespace depthmocap {

MarkerModel averageMarkerModel(const Skeleton& s) {
  const BoneLengths& l = s.lengths;
  const double up = l.torso - l.spine;
  MarkerModel model;
  const auto set = [&](Part part, Bone bone, double x, double y, double z) {
    model[static_cast<std::size_t>(partIndex(part))] = {bone, Eigen::Vector3d(x, y, z)};
  };
  set(Part::Head, Bone::Head, 0, s.head_center.y(), 0);
  set(Part::Neck, Bone::Neck, 0, 0.25 * l.neck_to_head, 0);
  set(Part::Torso, Bone::UpperBack, 0, 0.35 * up, 0);
  const auto side = [&](double sign, bool left) {
    set(left ? Part::LeftShoulder : Part::RightShoulder, left ? Bone::LeftClavicle : Bone::RightClavicle,
        s.offset[static_cast<std::size_t>(left ? Bone::LeftHumerus : Bone::RightHumerus)].x(), -0.5 * l.shoulder_drop, 0);
    set(left ? Part::LeftUpperArm : Part::RightUpperArm, left ? Bone::LeftHumerus : Bone::RightHumerus,
        sign * 0.6 * l.upper_arm, 0, 0);
    set(left ? Part::LeftLowerArm : Part::RightLowerArm, left ? Bone::LeftRadius : Bone::RightRadius,
        sign * 0.65 * l.lower_arm, 0, 0);
    set(left ? Part::LeftWaist : Part::RightWaist, Bone::Root, sign * 0.45 * l.hip_width, 0, 0);
    set(left ? Part::LeftUpperLeg : Part::RightUpperLeg, left ? Bone::LeftFemur : Bone::RightFemur, 0,
        -0.55 * l.upper_leg, 0);
    set(left ? Part::LeftLowerLeg : Part::RightLowerLeg, left ? Bone::LeftTibia : Bone::RightTibia, 0,
        -0.5 * l.lower_leg, 0);
  };
  side(1.0, true);
  side(-1.0, false);
  return model;
}

std::array<double, kPartCount> averagePartRadii(const Skeleton& s) {
  const double scale = statureOf(s.lengths) / statureOf(BoneLengths{});
  std::array<double, kPartCount> radii{0.09, 0.06, 0.07, 0.07, 0.045, 0.045, 0.038, 0.038,
                                       0.11, 0.11, 0.11, 0.075, 0.075, 0.052, 0.052};
  for (double& r : radii) r *= scale;
  return radii;
}

}  // namespace depthmocap

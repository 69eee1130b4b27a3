#include "libtracker/skeleton/typical_bone_lengths.h"

namespace depthmocap {

BoneLengths typicalBoneLengths(Sex sex, double stature_m) {
  BoneLengths l;
  if (sex == Sex::Female) {
    // Shares of the stature of women over those of men (de Leva 1996, biacromial and bispinous breadths of ANSUR).
    l.shoulder_width *= 0.945;
    l.hip_width *= 1.03;
    l.upper_arm *= 0.985;
    l.lower_arm *= 0.965;
    l.foot *= 0.965;
    l.neck_to_head *= 0.99;
    l.torso *= 1.01;
  }
  return l.scaled(stature_m / statureOf(l));
}

}  // namespace depthmocap

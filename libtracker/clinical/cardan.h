#pragma once
#include <Eigen/Core>

namespace depthmocap {

// Rotations of a segment in another one, as ISB recommends them for hips and trunk (Grood and Suntay 1983, Wu et al.
// 2002): about the axis to the actor's right, then forward, then up; R = R_right(flexion) R_forward(adduction)
// R_up(rotation). Both segments have our bones' axes: x left, y up, z forward. [rad], any turn.
struct CardanAngles {
  double flexion = 0;
  double adduction = 0;
  double rotation = 0;
};

// Of the two solutions and their turns the one nearest to `near`, so that angles go on from frame to frame. Where
// adduction is a right angle only the sum of the others shows; then flexion stays.
CardanAngles cardanAngles(const Eigen::Matrix3d& R, const CardanAngles& near = {});

// `angle` plus the whole turns that bring it nearest to `near` [rad].
double unwrapped(double angle, double near);

}  // namespace depthmocap

#pragma once
#include <Eigen/Core>
#include <span>

#include "libtracker/actor/body_template.h"
#include "libtracker/skeleton/normal_equations.h"
#include "libtracker/skeleton/surface_match.h"

namespace depthmocap {

using ShapeMatrix = Eigen::Matrix<double, kShapeCount, kShapeCount>;

// What one frame says of a body's shape, whatever its pose is: the quadratic model s^T A s - 2 b^T s of half the
// negative log likelihood (A: inverse covariance).
struct ShapeEvidence {
  ShapeMatrix A = ShapeMatrix::Zero();
  ShapeVector b = ShapeVector::Zero();
};

struct ShapeMatches {
  std::span<const SurfaceMatch> measured;  // depth points
  std::span<const SurfaceMatch> outline;   // lines of sight past the body (OutlineMatcher)
};

// From the fit of the frame: `matches` with the average template's surface of this `shape`, in the pose of `fk`;
// `pose`: all that the image says of that pose (MapSolver::expandEvidence), in which a measured
// match of weight 1 counts `scale` [1/m^2] times its squared distance. The pose is marginalised. Allocates nothing.
ShapeEvidence shapeEvidence(const ShapeVector& shape, const ForwardKinematics& fk, const ShapeMatches& matches,
                            double scale, NormalEquations pose);

// The shape of a body, bone lengths and girths, from the depth of many frames while it is tracked: the most likely one
// about what is typical of a stature. The same shapes as a calibration's (method section A (6)), without its T-pose.
class ShapeFit {
 public:
  void observe(const ShapeEvidence& frame);
  [[nodiscard]] int frames() const { return frames_; }  // observed
  // Of a body of about this stature [m]; each entry within 0.6 to 1.6 times what is typical.
  [[nodiscard]] ShapeVector best(double stature_m) const;
  // How well each entry is known: standard deviations, [m] and girths.
  [[nodiscard]] ShapeVector deviation(double stature_m) const;

  // What is typical of a stature [m].
  static ShapeVector typical(double stature_m);

 private:
  ShapeEvidence sum_;
  int frames_ = 0;
};

}  // namespace depthmocap

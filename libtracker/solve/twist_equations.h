#pragma once
#include <Eigen/Core>
#include <array>

#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/skeleton/normal_equations.h"

namespace depthmocap {

// Sums the quadratic models of energies of points of the body, bone by bone, and turns the sums into normal equations
// of the DoFs in one pass from the hands and feet to the root.
//
// A bone's velocity is a twist (angular velocity, velocity of what is rigid with the bone at the root's origin), so
// whatever was measured on a bone is one symmetric 6x6 matrix and one 6-vector. All twists are about the same point:
// what a bone's DoFs carry is the plain sum over the bones behind them (composite rigid bodies, Featherstone 2008,
// table 6.2), and the time does not depend on the number of points. Plain working memory, allocates nothing.
class TwistEquations {
 public:
  // Starts anew about the pose of `fk`, which must outlive the calls up to addTo().
  void reset(const ForwardKinematics& fk);

  // k |p - target|^2 of a point of `bone` now at p_world [m], k (>= 0) [1/m^2]; e = p - target [m].
  void addPoint(Bone bone, const Eigen::Vector3d& p_world, const Eigen::Vector3d& e, double k);
  // k (n . (p - target))^2; n_world: unit, off = n . (p - target) [m].
  void addPlane(Bone bone, const Eigen::Vector3d& p_world, const Eigen::Vector3d& n_world, double off, double k);

  // Adds g and the lower triangle of A; the energy is the caller's.
  void addTo(NormalEquations& equations) const;

 private:
  using Twist = Eigen::Matrix<double, 6, 1>;
  using TwistMatrix = Eigen::Matrix<double, 6, 6>;
  struct Sum {
    TwistMatrix A = TwistMatrix::Zero();
    Twist g = Twist::Zero();
  };
  [[nodiscard]] Twist twistOf(std::size_t bone, int dof) const;

  const ForwardKinematics* fk_ = nullptr;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();  // [m] world; what all twists are about
  std::array<Sum, kBoneCount> sums_;
};

}  // namespace depthmocap

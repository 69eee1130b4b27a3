#pragma once
#include <Eigen/Core>
#include <array>

#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/solve/residual_block.h"

namespace depthmocap {

inline constexpr int kFootPointCount = 4;  // ankle and toe, left and right

// A point of a foot that stands on the floor, and where.
struct FootContact {
  BonePoint point;
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  // [m]
  double weight = 0;                                  // [0, 1]; 0: does not stand
};

using FootContacts = std::array<FootContact, kFootPointCount>;

// Beyond the paper: what stands on the floor stays where it is. lambda * sum over contacts of weight * rho(|f(q) - p|),
// rho the Lorentzian: a contact that is wrong, or that the image contradicts, is given up.
//
// Rows: three per contact, then one per contact for its curvature (see RobustPull).
class ContactTerm {
 public:
  static constexpr int kResidualRows = 3 * kFootPointCount;
  static constexpr int kRows = kResidualRows + kFootPointCount;

  // `contacts` may be nullptr: no term. The references must outlive the term.
  ContactTerm(const Skeleton& skeleton, const FootContacts* contacts, double lambda, double sigma_m)
      : skeleton_(skeleton), contacts_(contacts), lambda_(lambda), sigma_m_(sigma_m) {}

  void evaluate(const Pose& q, ResidualRows r, JacobianRows* J);

 private:
  const Skeleton& skeleton_;
  const FootContacts* contacts_;
  double lambda_;
  double sigma_m_;
  ForwardKinematics fk_;
};

}  // namespace depthmocap

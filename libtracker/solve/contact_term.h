#pragma once
#include <Eigen/Core>
#include <array>

#include "libtracker/skeleton/forward_kinematics.h"
#include "libtracker/solve/twist_equations.h"

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
class ContactTerm {
 public:
  // `contacts` may be nullptr: no term; they must outlive the term.
  ContactTerm(const FootContacts* contacts, double lambda, double sigma_m)
      : contacts_(contacts), lambda_(lambda), sigma_m_(sigma_m) {}

  [[nodiscard]] double energy(const ForwardKinematics& fk) const;
  void addTo(const ForwardKinematics& fk, TwistEquations& equations) const;

 private:
  const FootContacts* contacts_;
  double lambda_;
  double sigma_m_;
};

}  // namespace depthmocap

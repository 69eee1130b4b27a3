#include "libtracker/solve/contact_term.h"

#include "libtracker/solve/robust_pull.h"

namespace depthmocap {

double ContactTerm::energy(const ForwardKinematics& fk) const {
  if (contacts_ == nullptr) return 0;
  double sum = 0;
  for (const FootContact& contact : *contacts_) {
    if (contact.weight <= 0) continue;
    const Eigen::Vector3d e = fk.position(contact.point) - contact.p_world;
    sum += robustPull(e.squaredNorm(), sigma_m_, lambda_ * contact.weight).energy;
  }
  return sum;
}

void ContactTerm::addTo(const ForwardKinematics& fk, TwistEquations& equations) const {
  if (contacts_ == nullptr) return;
  for (const FootContact& contact : *contacts_) {
    if (contact.weight <= 0) continue;
    const Eigen::Vector3d p = fk.position(contact.point);
    const Eigen::Vector3d e = p - contact.p_world;
    const RobustPull pull = robustPull(e.squaredNorm(), sigma_m_, lambda_ * contact.weight);
    equations.addPoint(contact.point.bone, p, e, pull.k);
  }
}

}  // namespace depthmocap

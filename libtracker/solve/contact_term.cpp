#include "libtracker/solve/contact_term.h"

#include "libtracker/solve/robust_pull.h"

namespace depthmocap {

void ContactTerm::evaluate(const Pose& q, ResidualRows r, JacobianRows* J) {
  r.setZero();
  if (J != nullptr) J->setZero();
  if (contacts_ == nullptr) return;
  fk_.update(skeleton_, q);
  for (int i = 0; i < kFootPointCount; ++i) {
    const FootContact& contact = (*contacts_)[static_cast<std::size_t>(i)];
    if (contact.weight <= 0) continue;
    const RobustPull pull =
        robustPull(fk_.position(contact.point) - contact.p_world, sigma_m_, lambda_ * contact.weight);
    r.segment<3>(3 * i) = pull.r;
    if (J == nullptr) continue;
    PointJacobian J_point;
    fk_.jacobian(contact.point, J_point);
    J->middleRows<3>(3 * i) = pull.dr_de.lazyProduct(J_point);
    J->row(kResidualRows + i) = pull.along.lazyProduct(J_point);
  }
}

}  // namespace depthmocap

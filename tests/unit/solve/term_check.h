#pragma once
#include "libtracker/solve/twist_equations.h"
#include "tests/gradient_check.h"

namespace depthmocap {

// Terms of points of the body take the pose's frames, the others take the pose: one view of both for the tests.
template <typename Term>
concept PointTerm = requires(const Term& term, const ForwardKinematics& fk) {
  term.energy(fk);
};

inline ForwardKinematics framesOf(const Skeleton& skeleton, const Pose& q) {
  ForwardKinematics fk;
  fk.update(skeleton, q);
  return fk;
}

template <typename Term>
double energyOf(const Term& term, const Skeleton& skeleton, const Pose& q) {
  if constexpr (PointTerm<Term>) {
    return term.energy(framesOf(skeleton, q));
  } else {
    return term.energy(q);
  }
}

template <typename Term>
NormalEquations equationsOf(const Term& term, const Skeleton& skeleton, const Pose& q) {
  NormalEquations equations;
  if constexpr (PointTerm<Term>) {
    const ForwardKinematics fk = framesOf(skeleton, q);
    TwistEquations twists;
    twists.reset(fk);
    term.addTo(fk, twists);
    twists.addTo(equations);
  } else {
    term.addTo(q, equations);
  }
  return equations;
}

// The slope of the energy at q against differences.
template <typename Term>
void expectGradientMatches(const Term& term, const Skeleton& skeleton, const Pose& q, double tolerance = 1e-6) {
  const auto energy = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return Eigen::VectorXd::Constant(1, energyOf(term, skeleton, x));
  };
  const auto gradient = [&](const Eigen::VectorXd& x) -> Eigen::MatrixXd {
    const NormalEquations equations = equationsOf(term, skeleton, x);
    EXPECT_TRUE(equations.A.allFinite());
    return 2.0 * equations.g.transpose();
  };
  expectJacobianMatches(q, energy, gradient, tolerance);
}

}  // namespace depthmocap

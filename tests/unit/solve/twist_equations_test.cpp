#include "libtracker/solve/twist_equations.h"

#include <gtest/gtest.h>

#include "libtracker/core/random.h"
#include "tests/moving_body.h"

namespace depthmocap {
namespace {

Eigen::Vector3d randomVector(Random& random) {
  return {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
}

// The same sums as one row a point, with the Jacobians of the points.
struct PlainEquations {
  Pose g = Pose::Zero();
  PoseMatrix A = PoseMatrix::Zero();

  void add(const Eigen::Matrix<double, Eigen::Dynamic, kDofCount>& J, const Eigen::VectorXd& r, double k) {
    g += k * J.transpose() * r;
    A += k * J.transpose() * J;
  }
};

void expectEqual(const NormalEquations& fast, const PlainEquations& plain) {
  EXPECT_LT((fast.g - plain.g).norm(), 1e-9 * plain.g.norm());
  const PoseMatrix lower = plain.A.triangularView<Eigen::Lower>();
  const PoseMatrix fast_lower = fast.A.triangularView<Eigen::Lower>();
  EXPECT_LT((fast_lower - lower).norm(), 1e-9 * lower.norm());
}

TEST(TwistEquations, AreThePlainSumOverPoints) {
  Random random(1);
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  TwistEquations twists;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    ForwardKinematics fk;
    fk.update(skeleton, MovingBody::motion(seed, 0.3));
    twists.reset(fk);
    PlainEquations plain;
    for (int i = 0; i < 3 * kBoneCount; ++i) {
      const BonePoint point{static_cast<Bone>(i % kBoneCount), 0.2 * randomVector(random)};
      const Eigen::Vector3d e = randomVector(random);
      const double k = random.uniform(0.0, 3.0);
      twists.addPoint(point.bone, fk.position(point), e, k);
      PointJacobian J;
      fk.jacobian(point, J);
      plain.add(J, e, k);
    }
    NormalEquations fast;
    twists.addTo(fast);
    expectEqual(fast, plain);
  }
}

TEST(TwistEquations, AreThePlainSumOverPlanes) {
  Random random(2);
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  TwistEquations twists;
  ForwardKinematics fk;
  fk.update(skeleton, MovingBody::motion(7, 0.1));
  twists.reset(fk);
  PlainEquations plain;
  for (int i = 0; i < 10 * kBoneCount; ++i) {
    const BonePoint point{static_cast<Bone>(i % kBoneCount), 0.2 * randomVector(random)};
    const Eigen::Vector3d n = randomVector(random).normalized();
    const double off = random.uniform(-0.1, 0.1);
    twists.addPlane(point.bone, fk.position(point), n, off, 2.0);
    PointJacobian J;
    fk.jacobian(point, J);
    plain.add(n.transpose() * J, Eigen::VectorXd::Constant(1, off), 2.0);
  }
  NormalEquations fast;
  twists.addTo(fast);
  expectEqual(fast, plain);
}

TEST(TwistEquations, AddToWhatIsThere) {
  const Skeleton skeleton = makeSkeleton(BoneLengths{});
  ForwardKinematics fk;
  fk.update(skeleton, MovingBody::motion(3, 0.1));
  TwistEquations twists;
  twists.reset(fk);
  NormalEquations equations;
  equations.A.setIdentity();
  equations.g.setOnes();
  twists.addTo(equations);
  EXPECT_EQ(equations.A, PoseMatrix::Identity());
  EXPECT_EQ(equations.g, Pose::Ones());
  twists.addPoint(Bone::LeftFoot, fk.origin(Bone::LeftFoot), Eigen::Vector3d::UnitX(), 1.0);
  twists.addTo(equations);
  EXPECT_EQ(equations.g[kRootTx], 2.0);
  twists.reset(fk);
  NormalEquations nothing;
  twists.addTo(nothing);
  EXPECT_EQ(nothing.A.norm(), 0);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/actor/body_template.h"

#include <gtest/gtest.h>

#include "libtracker/body/make_template_surface.h"
#include "libtracker/skeleton/typical_bone_lengths.h"

namespace depthmocap {
namespace {

ShapeVector otherShape() {
  ShapeVector shape = shapeVector(typicalBoneLengths(Sex::Female, 1.6), 0.95);
  shape[3] += 0.02;
  shape[kBoneLengthCount + static_cast<int>(Girth::UpperArm)] = 1.2;
  return shape;
}

TEST(BodyTemplate, ItsOwnShapeLeavesItAsItIs) {
  const BodyTemplate body(makeTemplateSurface(Sex::Male, 300));
  for (const auto& point : body.points()) {
    EXPECT_TRUE(body.place(point, body.templateShape()).isApprox(point.p0, 1e-9));
    EXPECT_TRUE(body.normal(point, body.templateShape()).isApprox(point.n0, 1e-6));
  }
}

TEST(BodyTemplate, ScaledBodyKeepsItsForm) {
  const BodyTemplate body(makeTemplateSurface(Sex::Female, 300));
  const ShapeVector twice = 2.0 * body.templateShape();
  for (const auto& point : body.points()) EXPECT_TRUE(body.place(point, twice).isApprox(2.0 * point.p0, 1e-9));
  EXPECT_NEAR(body.surface(twice).stature_m, 2.0 * statureOf(boneLengths(body.templateShape())), 1e-9);
}

TEST(BodyTemplate, PlaceIsLinearInTheShape) {
  const BodyTemplate body(makeTemplateSurface(Sex::Male, 300));
  const ShapeVector shape = otherShape();
  for (const auto& point : body.points()) {
    EXPECT_LT((body.placeJacobian(point) * shape - body.place(point, shape)).norm(), 1e-12);
  }
}

TEST(BodyTemplate, EndsLieAtCrownFingertipsAndSoles) {
  const BodyTemplate body(makeTemplateSurface(Sex::Male, 300));
  const Skeleton skeleton = makeSkeleton(boneLengths(body.templateShape()));
  ForwardKinematics fk;
  fk.update(skeleton, Pose::Zero());
  const auto world = [&](const BodyTemplate::Point& point) {
    return fk.position({point.bone, body.place(point, body.templateShape())});
  };
  const auto& ends = body.ends();
  EXPECT_NEAR(world(ends.crown).y() - world(ends.left_sole).y(), statureOf(boneLengths(body.templateShape())), 1e-6);
  EXPECT_NEAR(world(ends.left_tip).x(), -world(ends.right_tip).x(), 0.01);
  EXPECT_GT(world(ends.left_tip).x(), 0.45 * statureOf(boneLengths(body.templateShape())));
}

TEST(ShapeKinematics, JacobianMatchesDifferences) {
  const BodyTemplate body(makeTemplateSurface(Sex::Male, 120));
  const ShapeVector shape = otherShape();
  Pose q = Pose::Zero();
  for (int i = 0; i < kDofCount; ++i) q[i] = 0.1 * ((i * 7) % 5 - 2);
  const auto world = [&](const BodyTemplate::Point& point, const ShapeVector& at) {
    ForwardKinematics fk;
    fk.update(makeSkeleton(boneLengths(at)), q);
    return fk.position({point.bone, body.place(point, at)});
  };
  ForwardKinematics fk;
  fk.update(makeSkeleton(boneLengths(shape)), q);
  ShapeKinematics kinematics;
  kinematics.update(fk);
  for (std::size_t i = 0; i < body.points().size(); i += 7) {
    const auto& point = body.points()[i];
    const ShapeJacobian J = kinematics.jacobian(fk, point.bone, body.placeJacobian(point));
    for (int k = 0; k < kShapeCount; ++k) {
      const ShapeVector step = 1e-4 * ShapeVector::Unit(k);
      const Eigen::Vector3d difference = (world(point, shape + step) - world(point, shape - step)) / 2e-4;
      EXPECT_LT((J.col(k) - difference).norm(), 1e-8);
    }
  }
}

}  // namespace
}  // namespace depthmocap

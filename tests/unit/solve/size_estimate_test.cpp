#include "libtracker/solve/size_estimate.h"

#include <gtest/gtest.h>

#include "tests/moving_body.h"

namespace depthmocap {
namespace {

// The markers that an actor `scale` times as large as the scene's skeleton shows in pose q.
MarkerSet markersOfSize(const MovingBody& scene, const Pose& q, double scale) {
  MovingBody other;
  other.skeleton = makeSkeleton(scene.skeleton.lengths.scaled(scale));
  other.model = averageMarkerModel(other.skeleton);
  return other.markers(q);
}

ForwardKinematics fkOf(const MovingBody& scene, const Pose& q) {
  ForwardKinematics fk;
  fk.update(scene.skeleton, q);
  return fk;
}

TEST(EstimateSize, FindsTheScaleExactlyWhereverTheActorStands) {
  const MovingBody scene;
  const Pose q = MovingBody::motion(1, 0.4);
  Pose elsewhere = q;
  elsewhere.head<3>() << 4, 1, -7;
  for (const double scale : {0.8, 1.0, 1.15}) {
    const SizeEstimate estimate = estimateSize(fkOf(scene, elsewhere), scene.model, markersOfSize(scene, q, scale));
    EXPECT_TRUE(estimate.valid);
    EXPECT_NEAR(estimate.scale, scale, 1e-9);
  }
}

TEST(EstimateSize, StrayAndMissingMarkersHardlyMatter) {
  const MovingBody scene;
  const Pose q = MovingBody::motion(2, 0.4);
  MarkerSet markers = markersOfSize(scene, q, 1.06);
  markers.position.col(partIndex(Part::LeftLowerArm)).array() += 0.8;
  markers.confidence[partIndex(Part::Head)] = 0;
  markers.position.col(partIndex(Part::Head)).setConstant(1e5);
  EXPECT_NEAR(estimateSize(fkOf(scene, q), scene.model, markers).scale, 1.06, 0.015);
}

TEST(EstimateSize, IsInvalidWithTooFewMarkersOrNoExtent) {
  const MovingBody scene;
  const Pose q = MovingBody::motion(2, 0.4);
  MarkerSet markers = scene.markers(q);
  markers.confidence.tail<kPartCount - 3>().setZero();
  EXPECT_FALSE(estimateSize(fkOf(scene, q), scene.model, markers).valid);
  markers.confidence.setOnes();
  markers.position.colwise() = Eigen::Vector3d(0, 0, 1);
  const SizeEstimate flat = estimateSize(fkOf(scene, q), scene.model, markers);
  EXPECT_FALSE(flat.valid);
  EXPECT_EQ(flat.scale, 1.0);
}

}  // namespace
}  // namespace depthmocap

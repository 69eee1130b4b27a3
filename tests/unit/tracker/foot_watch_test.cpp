#include "libtracker/tracker/foot_watch.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libtracker/core/random.h"

namespace depthmocap {
namespace {

constexpr double kFrame_s = 1.0 / 30.0;
enum { kLeftAnkle, kLeftToe, kRightAnkle, kRightToe };

// Poses of a body that stands at y = 0, one after the other.
class Walker {
 public:
  Pose standing() const {
    Pose q = Pose::Zero();
    q[kRootTy] = lengths.hip_drop + lengths.upper_leg + lengths.lower_leg + ankleHeight(lengths);
    q[kRootTz] = -2.5;
    return q;
  }
  // The thigh raised by `angle` [rad], the shank upright.
  Pose kneeRaised(double angle) const {
    Pose q = standing();
    q[kLfemurRx] = -angle;
    q[kLtibiaRx] = angle;
    return q;
  }
  const FootContacts& show(const Pose& q, const std::optional<Eigen::Vector4d>& floor = std::nullopt) {
    time_s += kFrame_s;
    watch.observe(skeleton, q, time_s, floor);
    return watch.contacts();
  }
  const FootContacts& stand(int frames) {
    for (int i = 0; i < frames; ++i) show(standing());
    return watch.contacts();
  }

  BoneLengths lengths;
  Skeleton skeleton = makeSkeleton(lengths);
  FootWatch watch;
  double time_s = 1.0;
};

TEST(FootWatch, FeetThatRestOnTheFloorStandWhereTheyAre) {
  Walker walker;
  EXPECT_EQ(walker.stand(2)[kLeftAnkle].weight, 0);  // too early to tell
  const FootContacts& contacts = walker.stand(4);
  ForwardKinematics fk;
  fk.update(walker.skeleton, walker.standing());
  for (const FootContact& contact : contacts) {
    EXPECT_GT(contact.weight, 0);
    EXPECT_LT(contact.weight, 1);
    EXPECT_LT((contact.p_world - fk.position(contact.point)).norm(), 1e-9);
  }
  for (const FootContact& contact : walker.stand(15)) EXPECT_EQ(contact.weight, 1);  // with growing weight
}

TEST(FootWatch, NoiseDoesNotMoveAPlaceMuch) {
  Walker walker;
  walker.stand(20);
  const Eigen::Vector3d before = walker.watch.contacts()[kRightAnkle].p_world;
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    Pose q = walker.standing();
    for (int k = 0; k < 3; ++k) q[k] += 0.005 * random.normal();
    const FootContact& contact = walker.show(q)[kRightAnkle];
    EXPECT_EQ(contact.weight, 1);
    EXPECT_LT((contact.p_world - before).norm(), 0.005);
  }
}

TEST(FootWatch, WalkingOnTheSpotLiftsOneFootAndKeepsTheOther) {
  Walker walker;
  walker.stand(10);
  for (int i = 1; i <= 8; ++i) walker.show(walker.kneeRaised(0.12 * i));
  for (int i = 0; i < 10; ++i) walker.show(walker.kneeRaised(0.96));  // held up: rests, but not on the floor
  const FootContacts& contacts = walker.watch.contacts();
  EXPECT_EQ(contacts[kLeftAnkle].weight, 0);
  EXPECT_EQ(contacts[kLeftToe].weight, 0);
  EXPECT_EQ(contacts[kRightAnkle].weight, 1);
  EXPECT_EQ(contacts[kRightToe].weight, 1);
  for (int i = 8; i >= 0; --i) walker.show(walker.kneeRaised(0.12 * i));
  EXPECT_GT(walker.stand(8)[kLeftAnkle].weight, 0);
}

TEST(FootWatch, NothingStandsInAJump) {
  Walker walker;
  walker.stand(10);
  for (int i = 1; i <= 15; ++i) {
    const double t = i * kFrame_s;
    Pose q = walker.standing();
    q[kRootTy] += 2.5 * t - 4.9 * t * t;  // slow, and far from the floor, at the top
    const FootContacts& contacts = walker.show(q);
    if (i < 3) continue;
    for (const FootContact& contact : contacts) EXPECT_EQ(contact.weight, 0) << "frame " << i;
  }
  for (const FootContact& contact : walker.stand(8)) EXPECT_GT(contact.weight, 0);
}

TEST(FootWatch, SlidingFeetDoNotStand) {
  Walker walker;
  for (int i = 0; i < 30; ++i) {
    Pose q = walker.standing();
    q[kRootTx] = 0.5 * i * kFrame_s;  // half a metre a second
    for (const FootContact& contact : walker.show(q)) EXPECT_EQ(contact.weight, 0) << "frame " << i;
  }
}

TEST(FootWatch, ASeenFloorSaysWhatIsOnIt) {
  Walker walker;
  const Eigen::Vector4d below(0, 1, 0, 0.3);  // the floor lies 30 cm below the soles
  for (int i = 0; i < 20; ++i) {
    for (const FootContact& contact : walker.show(walker.standing(), below)) EXPECT_EQ(contact.weight, 0);
  }
  const Eigen::Vector4d at_the_soles(0, 1, 0, 0);
  for (int i = 0; i < 5; ++i) walker.show(walker.standing(), at_the_soles);
  for (const FootContact& contact : walker.watch.contacts()) EXPECT_GT(contact.weight, 0);
}

TEST(FootWatch, ForgetsWhenReset) {
  Walker walker;
  walker.stand(10);
  walker.watch.reset();
  for (const FootContact& contact : walker.watch.contacts()) EXPECT_EQ(contact.weight, 0);
  EXPECT_EQ(walker.stand(2)[kLeftAnkle].weight, 0);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/solve/contact_term.h"

#include <cmath>

#include <gtest/gtest.h>

#include "libtracker/solve/map_solver.h"
#include "tests/moving_body.h"
#include "tests/unit/solve/term_check.h"

namespace depthmocap {
namespace {

constexpr double kSigma_m = 0.02;

// All four points where a pose has them.
FootContacts contactsAt(const MovingBody& scene, const Pose& q) {
  ForwardKinematics fk;
  fk.update(scene.skeleton, q);
  FootContacts contacts;
  const std::array<BonePoint, kFootPointCount> points = {{{Bone::LeftFoot, Eigen::Vector3d::Zero()},
                                                          {Bone::LeftFoot, scene.skeleton.left_toe},
                                                          {Bone::RightFoot, Eigen::Vector3d::Zero()},
                                                          {Bone::RightFoot, scene.skeleton.right_toe}}};
  for (std::size_t i = 0; i < points.size(); ++i) contacts[i] = {points[i], fk.position(points[i]), 1.0};
  return contacts;
}

TEST(ContactTerm, GradientMatchesDifferences) {
  const MovingBody scene;
  const FootContacts contacts = contactsAt(scene, MovingBody::motion(1, 0.3));
  const ContactTerm term(&contacts, 5.0, kSigma_m);
  for (const double t : {0.3, 0.301, 0.32, 0.6}) {
    expectGradientMatches(term, scene.skeleton, MovingBody::motion(1, t), 1e-5);
  }
}

TEST(ContactTerm, EnergyIsTheLorentzianOfThePointsThatStand) {
  const MovingBody scene;
  const Pose q = MovingBody::motion(2, 0.0);
  FootContacts contacts = contactsAt(scene, q);
  contacts[0].p_world.x() += 0.03;
  contacts[1].p_world.z() -= 0.5;
  contacts[1].weight = 0.25;
  contacts[2].p_world.y() += 9.0;
  contacts[2].weight = 0;
  const ContactTerm term(&contacts, 5.0, kSigma_m);
  const auto rho = [](double e) { return std::log1p(e * e / (2 * kSigma_m * kSigma_m)); };
  EXPECT_NEAR(energyOf(term, scene.skeleton, q), 5.0 * (rho(0.03) + 0.25 * rho(0.5)), 1e-9);
}

TEST(ContactTerm, IsSilentWithoutContacts) {
  const MovingBody scene;
  const ContactTerm none(nullptr, 5.0, kSigma_m);
  EXPECT_EQ(energyOf(none, scene.skeleton, Pose::Zero()), 0);
  const FootContacts nothing_stands;
  const ContactTerm term(&nothing_stands, 5.0, kSigma_m);
  EXPECT_EQ(energyOf(term, scene.skeleton, Pose::Zero()), 0);
}

double ankleDistance(const MovingBody& scene, const Pose& q, const Eigen::Vector3d& p_world) {
  ForwardKinematics fk;
  fk.update(scene.skeleton, q);
  return (fk.origin(Bone::LeftFoot) - p_world).norm();
}

TEST(ContactTerm, HoldsAFootAgainstNoisyMarkers) {
  const MovingBody scene;
  const Pose truth = MovingBody::motion(3, 1.0);
  const FootContacts contacts = contactsAt(scene, truth);
  Random random(1);
  MapSolver solver{MapConfig{}};
  double free_m = 0;
  double held_m = 0;
  for (int i = 0; i < 10; ++i) {
    const MarkerSet markers = scene.noisyMarkers(truth, 0.03, 0, random);
    MapInput input{scene.skeleton, scene.model, markers};
    Pose q = truth;
    solver.solve(input, q);
    free_m += ankleDistance(scene, q, contacts[0].p_world) / 10;
    input.contacts = &contacts;
    q = truth;
    const MapSummary summary = solver.solve(input, q);
    EXPECT_GT(summary.e_contact, 0);
    held_m += ankleDistance(scene, q, contacts[0].p_world) / 10;
  }
  EXPECT_LT(held_m, 0.4 * free_m);
}

// A foot that has been lifted is not glued: what little is seen of the leg wins.
TEST(ContactTerm, AWrongContactIsGivenUp) {
  const MovingBody scene;
  Pose lifted = Pose::Zero();
  lifted[kLfemurRx] = -0.9;
  lifted[kLtibiaRx] = 1.2;
  const FootContacts on_the_floor = contactsAt(scene, Pose::Zero());
  const MarkerSet markers = scene.markers(lifted);
  MapInput input{scene.skeleton, scene.model, markers};
  input.contacts = &on_the_floor;
  MapSolver solver{MapConfig{}};
  Pose q = lifted;
  solver.solve(input, q);
  ForwardKinematics fk;
  fk.update(scene.skeleton, lifted);
  EXPECT_LT(ankleDistance(scene, q, fk.origin(Bone::LeftFoot)), 0.1);
  EXPECT_GT(ankleDistance(scene, q, on_the_floor[0].p_world), 0.15);
}

}  // namespace
}  // namespace depthmocap

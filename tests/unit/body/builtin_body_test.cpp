#include "libtracker/body/builtin_body.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/skeleton/forward_kinematics.h"
#include "tests/unit/body/body_checks.h"

namespace depthmocap {
namespace {

const std::array<BodyShape, 4> kShapes = {
    {{Sex::Male, 1.78, 76}, {Sex::Female, 1.65, 60}, {Sex::Male, 1.70, 108}, {Sex::Female, 1.52, 40}}};

const BodySurface& bodyOf(std::size_t i) {
  static std::array<BodySurface, 4> bodies;
  if (bodies[i].vertices.empty()) bodies[i] = makeBuiltinBody(kShapes[i]);
  return bodies[i];
}

TEST(BuiltinBody, IsClosedAndTurnedOutwards) {
  for (std::size_t i = 0; i < kShapes.size(); ++i) {
    const BodySurface& body = bodyOf(i);
    EXPECT_EQ(openEdges(body), 0U);
    EXPECT_GT(enclosedVolume(body.vertices, body.triangles), 0);
    EXPECT_GT(body.triangles.size(), 15000U);
    EXPECT_LT(body.triangles.size(), 45000U);
  }
}

TEST(BuiltinBody, HasTheWantedStatureAndWeight) {
  for (std::size_t i = 0; i < kShapes.size(); ++i) {
    EXPECT_NEAR(heightOf(bodyOf(i)), kShapes[i].stature_m, 0.01);
    EXPECT_NEAR(kilogramsOf(bodyOf(i)), kShapes[i].weight_kg, 0.02 * kShapes[i].weight_kg);
  }
}

TEST(BuiltinBody, HoldsItsJoints) {
  for (std::size_t i = 0; i < kShapes.size(); ++i) {
    const BodySurface& body = bodyOf(i);
    const JointPositions joints = jointPositions(body.skeleton, Pose::Zero());
    for (int j = 0; j < kJointCount; ++j) {
      EXPECT_NEAR(windingNumber(body, joints.col(j)), 1.0, 0.01) << kJointNames[static_cast<std::size_t>(j)];
    }
  }
}

TEST(BuiltinBody, IsItsOwnMirrorImage) {
  const BodySurface& body = bodyOf(1);
  const auto less = [](const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
    return std::tuple(a.y(), a.z(), a.x()) < std::tuple(b.y(), b.z(), b.x());
  };
  std::vector<Eigen::Vector3f> sorted = body.vertices;
  std::sort(sorted.begin(), sorted.end(), less);
  std::size_t lonely = 0;
  for (const Eigen::Vector3f& v : body.vertices) {
    const Eigen::Vector3f mirror(-v.x(), v.y(), v.z());
    auto near = std::lower_bound(sorted.begin(), sorted.end(), Eigen::Vector3f(-9, v.y() - 1e-5F, -9), less);
    bool found = false;
    for (; near != sorted.end() && near->y() < v.y() + 1e-5F && !found; ++near) found = (*near - mirror).norm() < 2e-5F;
    if (!found) ++lonely;
  }
  EXPECT_EQ(lonely, 0U);
}

TEST(BuiltinBody, IsTheSameEachTime) {
  const BodySurface& a = bodyOf(0);
  const BodySurface b = makeBuiltinBody(kShapes[0]);
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  EXPECT_TRUE(std::equal(a.vertices.begin(), a.vertices.end(), b.vertices.begin()));
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(BuiltinBody, RefusesImpossibleShapes) {
  EXPECT_THROW(makeBuiltinBody({Sex::Male, 0.3, 70}), Error);
  EXPECT_THROW(makeBuiltinBody({Sex::Male, 1.8, 500}), Error);
  EXPECT_THROW(makeBuiltinBody({Sex::Male, std::nan(""), 70}), Error);
  EXPECT_THROW(makeBuiltinBody({Sex::Female, 2.2, 30}), Error);
  EXPECT_THROW(makeBuiltinBody({Sex::Male, 1.0, 160}), Error);
}

TEST(BuiltinBody, WomenHaveNarrowerShouldersAndWiderHips) {
  const BoneLengths man = typicalBoneLengths(Sex::Male, 1.70);
  const BoneLengths woman = typicalBoneLengths(Sex::Female, 1.70);
  EXPECT_LT(woman.shoulder_width, man.shoulder_width);
  EXPECT_GT(woman.hip_width, man.hip_width);
  EXPECT_NEAR(statureOf(woman), 1.70, 1e-9);
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/body/sample_body.h"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "libtracker/core/parallel.h"
#include "tests/unit/body/body_checks.h"

namespace depthmocap {
namespace {

TEST(SampleBody, AdultsStayInTheirRangesAndSpreadOverThem) {
  Random random(7);
  std::vector<double> statures;
  std::vector<double> indices;
  int men = 0;
  for (int i = 0; i < 2000; ++i) {
    const BodyShape shape = sampleBodyShape(random);
    men += shape.sex == Sex::Male ? 1 : 0;
    statures.push_back(shape.stature_m);
    indices.push_back(shape.weight_kg / (shape.stature_m * shape.stature_m));
  }
  EXPECT_NEAR(men, 1000, 100);
  const auto [short_one, tall_one] = std::minmax_element(statures.begin(), statures.end());
  EXPECT_GE(*short_one, 1.5);
  EXPECT_LE(*tall_one, 2.0);
  EXPECT_GT(*tall_one - *short_one, 0.35);
  const auto [thin_one, fat_one] = std::minmax_element(indices.begin(), indices.end());
  EXPECT_GE(*thin_one, 17.0 - 1e-9);
  EXPECT_LE(*fat_one, 36.0 + 1e-9);
  EXPECT_GT(*fat_one - *thin_one, 12.0);
}

TEST(SampleBody, MakeHumanShapesStayInTheMacrosRanges) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const MakeHumanShape s = sampleMakeHumanShape(random);
    for (const double macro : {s.male, s.muscle, s.weight, s.height, s.proportions}) {
      EXPECT_GE(macro, 0.0);
      EXPECT_LE(macro, 1.0);
    }
    EXPECT_GE(s.age_years, 25.0);
    EXPECT_LE(s.age_years, 90.0);
    EXPECT_GT(s.african + s.asian + s.caucasian, 0.0);
    EXPECT_GE(s.stature_m, 1.5);
    EXPECT_LE(s.stature_m, 2.0);
  }
}

TEST(SampleBody, TheSameSeedGivesTheSamePeople) {
  Random a(11);
  Random b(11);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(sampleBodyShape(a).weight_kg, sampleBodyShape(b).weight_kg);
    EXPECT_EQ(sampleMakeHumanShape(a).weight, sampleMakeHumanShape(b).weight);
  }
}

TEST(SampleBody, DressedPeopleDoNotDependOnThreads) {
  const auto people = [](int threads) {
    std::vector<BodySurface> bodies(3);
    parallelFor(threads, bodies.size(), [&](std::size_t i) {
      Random random(i);
      bodies[i] = sampleDressedBody(random, nullptr);
    });
    return bodies;
  };
  const std::vector<BodySurface> serial = people(1);
  const std::vector<BodySurface> parallel = people(3);
  for (std::size_t i = 0; i < serial.size(); ++i) {
    EXPECT_EQ(openEdges(serial[i]), 0U);
    ASSERT_EQ(serial[i].vertices.size(), parallel[i].vertices.size());
    EXPECT_TRUE(std::equal(serial[i].vertices.begin(), serial[i].vertices.end(), parallel[i].vertices.begin()));
  }
  EXPECT_NE(serial[0].vertices.size(), serial[1].vertices.size());
}

}  // namespace
}  // namespace depthmocap

#include "libtracker/body/clothing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "libtracker/body/builtin_body.h"
#include "tests/unit/body/body_checks.h"

namespace depthmocap {
namespace {

const BodySurface& bare() {
  static const BodySurface body = makeBuiltinBody({Sex::Female, 1.68, 62});
  return body;
}

BodySurface dressed(const Clothing& clothing) {
  BodySurface body = bare();
  dress(body, clothing);
  return body;
}

double farthest(const BodySurface& body, auto&& chosen) {
  float far = 0;
  for (std::size_t i = 0; i < body.vertices.size(); ++i) {
    if (chosen(bare().vertices[i])) far = std::max(far, (body.vertices[i] - bare().vertices[i]).norm());
  }
  return static_cast<double>(far);
}

TEST(Clothing, NothingWornChangesNothing) {
  const auto all = [](const Eigen::Vector3f&) { return true; };
  EXPECT_LT(farthest(dressed({}), all), 1e-6);
}

TEST(Clothing, APulloverStandsOffTheTrunkAndLeavesHandsAndLegs) {
  const BodySurface body = dressed({.top_m = 0.03, .sleeve = 1.0, .wrinkles = 0});
  const float wrist = static_cast<float>(0.5 * bare().skeleton.lengths.shoulder_width +
                                         bare().skeleton.lengths.upper_arm + bare().skeleton.lengths.lower_arm);
  EXPECT_NEAR(farthest(body, [](const auto& v) { return v.y() > 0.2F && v.y() < 0.3F && std::abs(v.x()) < 0.2F; }),
              0.03, 1e-4);
  EXPECT_LT(farthest(body, [&](const auto& v) { return std::abs(v.x()) > wrist + 0.02F; }), 1e-6);
  EXPECT_LT(farthest(body, [](const auto& v) { return v.y() < -0.3F; }), 1e-6);
}

TEST(Clothing, LegsStayApartAndVolumeGrows) {
  for (const Clothing& clothing : {Clothing{.trousers_m = 0.05, .trouser_flare_m = 0.06, .wrinkles = 0.8},
                                   Clothing{.skirt_length = 0.7, .skirt_flare_m = 0.2}}) {
    const BodySurface body = dressed(clothing);
    EXPECT_EQ(openEdges(body), 0U);
    EXPECT_GT(kilogramsOf(body), 1.1 * kilogramsOf(bare()));
    for (std::size_t i = 0; i < body.vertices.size(); ++i) {
      const Eigen::Vector3f& skin = bare().vertices[i];
      if (skin.y() < -0.2F && std::abs(skin.x()) < 0.2F) {
        EXPECT_GT(body.vertices[i].x() * std::copysign(1.0F, skin.x()), 0.0F);
      }
    }
  }
}

TEST(Clothing, ASkirtIsWiderAtItsHemThanTheLegs) {
  const BodySurface body = dressed({.skirt_length = 0.6, .skirt_flare_m = 0.15});
  const BoneLengths& l = body.skeleton.lengths;
  const auto hem = static_cast<float>(-l.hip_drop - 0.55 * (l.upper_leg + l.lower_leg));
  float skin_width = 0;
  float skirt_width = 0;
  for (std::size_t i = 0; i < body.vertices.size(); ++i) {
    if (std::abs(bare().vertices[i].y() - hem) > 0.02F) continue;
    skin_width = std::max(skin_width, bare().vertices[i].x());
    skirt_width = std::max(skirt_width, body.vertices[i].x());
  }
  EXPECT_GT(skirt_width, skin_width + 0.05F);
}

TEST(Clothing, SamplesAreValidAndVaried) {
  Random random(5);
  int skirts = 0;
  int long_hair = 0;
  for (int i = 0; i < 300; ++i) {
    const Clothing clothing = sampleClothing(random);
    skirts += clothing.skirt_length > 0 ? 1 : 0;
    long_hair += clothing.hair_length > 0.3 ? 1 : 0;
    if (i < 10) {
      EXPECT_NO_THROW((void)dressed(clothing));
    }
  }
  EXPECT_GT(skirts, 10);
  EXPECT_LT(skirts, 60);
  EXPECT_GT(long_hair, 30);
}

TEST(Clothing, RefusesImpossibleClothes) {
  EXPECT_THROW((void)dressed({.top_m = 0.5}), Error);
  EXPECT_THROW((void)dressed({.hair_m = -0.1}), Error);
  EXPECT_THROW((void)dressed({.wrinkles = std::nan("")}), Error);
}

}  // namespace
}  // namespace depthmocap

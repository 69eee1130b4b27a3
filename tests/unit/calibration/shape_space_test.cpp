#include "calibration/shape_space.h"

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"
#include "libtracker/core/random.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

std::vector<BoneLengths> somePeople() {
  Random random(5);
  std::vector<BoneLengths> people;
  for (int i = 0; i < 13; ++i) {
    BoneLengths lengths = typicalBoneLengths(i % 2 == 0 ? Sex::Male : Sex::Female, random.uniform(1.55, 1.9));
    lengths.upper_leg *= random.uniform(0.95, 1.05);
    lengths.torso *= random.uniform(0.96, 1.04);
    people.push_back(lengths);
  }
  return people;
}

TEST(ShapeSpace, ComponentsAreOrthonormalAndOrdered) {
  const ShapeSpace space = makeShapeSpace(somePeople(), 0.99, "test");
  EXPECT_TRUE((space.H.transpose() * space.H).isIdentity(1e-9));
  for (Eigen::Index k = 1; k < space.deviation.size(); ++k) EXPECT_GE(space.deviation[k - 1], space.deviation[k]);
}

TEST(ShapeSpace, FirstComponentIsTheSize) {
  const ShapeSpace space = makeShapeSpace(somePeople(), 0.99, "test");
  EXPECT_TRUE((space.H.col(0).array() > 0).all());
  // One deviation of it is about one of the stature.
  const double taller = statureOf(boneLengths(LengthVector(space.mean + space.deviation[0] * space.H.col(0))));
  EXPECT_NEAR(taller - statureOf(boneLengths(space.mean)), 0.10, 0.03);
}

TEST(ShapeSpace, TallAndSmallPeopleLieInside) {
  const ShapeSpace space = makeShapeSpace(somePeople(), 0.99, "test");
  for (const Sex sex : {Sex::Male, Sex::Female}) {
    for (const double stature : {1.5, 1.7, 1.95}) {
      EXPECT_LT(space.offSpace(lengthVector(typicalBoneLengths(sex, stature))).norm(), 0.012);
    }
  }
}

TEST(ShapeSpace, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const ShapeSpace space = makeShapeSpace(somePeople(), 0.95, "test");
  saveShapeSpace(folder / "s.json", space);
  const ShapeSpace read = loadShapeSpace(folder / "s.json");
  EXPECT_EQ(read.H, space.H);
  EXPECT_EQ(read.mean, space.mean);
  EXPECT_EQ(read.deviation, space.deviation);
}

TEST(ShapeSpace, RefusesWhatIsNone) {
  const TemporaryFolder folder;
  EXPECT_NE(errorOf([&] { loadShapeSpace(folder / "none.json"); }).find("cannot read"), std::string::npos);
  writeBytes(folder / "s.json", R"({"format": "depthmocap-shape-space", "version": 1, "origin": "x"})");
  EXPECT_NE(errorOf([&] { loadShapeSpace(folder / "s.json"); }).find("missing"), std::string::npos);
  saveShapeSpace(folder / "s.json", makeShapeSpace(somePeople(), 0.95, "test"));
  std::string text = readBytes(folder / "s.json");
  const auto at = text.find("\"direction\"");
  const auto number = text.find("0.", at);
  text[number + 2] = text[number + 2] == '9' ? '1' : '9';
  writeBytes(folder / "s.json", text);
  EXPECT_NE(errorOf([&] { loadShapeSpace(folder / "s.json"); }).find("not orthonormal"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap

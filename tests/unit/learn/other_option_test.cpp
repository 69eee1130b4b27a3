#include "apps/learn/other_option.h"

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

TEST(OtherOption, TakesAMotionAlone) {
  const OtherOption option = parseOther("procedural:walk");
  EXPECT_EQ(option.motion, "procedural:walk");
  EXPECT_EQ(option.distance_m, 3.5);
  EXPECT_NEAR(option.shape.weight_kg, 23.5 * option.shape.stature_m * option.shape.stature_m, 1e-9);
}

TEST(OtherOption, TakesWhatIsSaid) {
  const OtherOption option = parseOther("a b.bvh,distance=2.5,yaw=-90,aside=0.4,height=1.6,weight=70,sex=f,first=12");
  EXPECT_EQ(option.motion, "a b.bvh");
  EXPECT_EQ(option.distance_m, 2.5);
  EXPECT_EQ(option.yaw_deg, -90);
  EXPECT_EQ(option.aside_m, 0.4);
  EXPECT_EQ(option.shape.stature_m, 1.6);
  EXPECT_EQ(option.shape.weight_kg, 70);
  EXPECT_EQ(option.shape.sex, Sex::Female);
  EXPECT_EQ(option.first, 12);
}

TEST(OtherOption, SaysWhatIsWrong) {
  const auto error = [](const char* text) { return errorOf([&] { (void)parseOther(text); }); };
  EXPECT_NE(error("").find("no motion"), std::string::npos);
  EXPECT_NE(error("walk,fast=1").find("there is no 'fast'"), std::string::npos);
  EXPECT_NE(error("walk,yaw").find("has no value"), std::string::npos);
  EXPECT_NE(error("walk,yaw=nan").find("from -360 to 360"), std::string::npos);
  EXPECT_NE(error("walk,distance=0").find("from 0.3 to 10"), std::string::npos);
  EXPECT_NE(error("walk,sex=x").find("m or f"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap

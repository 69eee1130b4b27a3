#include "forest/render/room_view.h"

#include <gtest/gtest.h>

#include "libtracker/body/builtin_body.h"

namespace depthmocap {
namespace {

struct Counts {
  int person = 0;
  int shell = 0;
  int thing = 0;
};

Counts countsOf(const RoomView& view) {
  Counts counts;
  for (const std::uint8_t c : view.classes.data) {
    counts.person += c == static_cast<std::uint8_t>(RoomClass::Person) ? 1 : 0;
    counts.shell += c == static_cast<std::uint8_t>(RoomClass::Shell) ? 1 : 0;
    counts.thing += c == static_cast<std::uint8_t>(RoomClass::Thing) ? 1 : 0;
  }
  return counts;
}

RoomView viewOf(const RoomViewConfig& config, std::uint64_t seed) {
  static const std::vector<BodySurface> bodies = {makeBuiltinBody(BodyShape{})};
  RoomViewRenderer renderer(config);
  Random random(seed);
  RoomView view;
  renderer.render(
      bodies, [](Random&) { return Pose(Pose::Zero()); }, random, view);
  return view;
}

TEST(RoomView, DependsOnItsArgumentsAlone) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const RoomView a = viewOf({}, seed);
    const RoomView b = viewOf({}, seed);
    EXPECT_EQ(a.depth.data, b.depth.data);
    EXPECT_EQ(a.classes.data, b.classes.data);
    EXPECT_EQ(a.camera.fx, b.camera.fx);
  }
}

TEST(RoomView, WhatIsNotMeasuredHasNoClassAndDepthsAreInRange) {
  const RoomViewConfig config;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const RoomView view = viewOf(config, seed);
    ASSERT_EQ(view.depth.data.size(), view.classes.data.size());
    for (std::size_t i = 0; i < view.depth.data.size(); ++i) {
      const float z = view.depth.data[i];
      if (z <= 0) {
        ASSERT_EQ(view.classes.data[i], 0);
      }
      ASSERT_LE(z, static_cast<float>(config.max_depth_m));
    }
  }
}

TEST(RoomView, PeopleAreInTheRoomsThatShallHaveThemAndInNoOthers) {
  RoomViewConfig inhabited;
  inhabited.empty_share = 0;
  RoomViewConfig empty;
  empty.empty_share = 1;
  int with_people = 0;
  Counts all;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    EXPECT_EQ(countsOf(viewOf(empty, seed)).person, 0);
    const Counts counts = countsOf(viewOf(inhabited, seed));
    with_people += counts.person > 50 ? 1 : 0;
    all.shell += counts.shell;
    all.thing += counts.thing;
  }
  EXPECT_GE(with_people, 30) << "a few are behind furniture or beyond the sensor";
  EXPECT_GT(all.shell, 40 * 1000);
  EXPECT_GT(all.thing, 40 * 200);
}

}  // namespace
}  // namespace depthmocap

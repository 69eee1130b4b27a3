#include "libtracker/segment/choose_person.h"

#include <array>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

// A piece of a person's size.
Component pieceAt(double x_m) {
  Component piece;
  piece.cells = 900;
  piece.area_m2 = 0.5F;
  piece.mean = {static_cast<float>(x_m), 0, 3};
  piece.low = piece.mean - Eigen::Vector3f(0.25F, 0.85F, 0.1F);
  piece.high = piece.mean + Eigen::Vector3f(0.25F, 0.85F, 0.1F);
  piece.bottom_m = -0.85F;
  piece.top_m = 0.85F;
  piece.thickness_m = 0.06F;
  return piece;
}

ExpectedActor unseenAt(double x_m) {
  return {.p_camera = {x_m, 0, 3}, .unseen_s = 0.3};
}

TEST(ChoosePerson, LeavesWhatIsNearerToWhereSomebodyElseIsMissing) {
  const std::vector<Component> pieces = {pieceAt(0.4)};
  const std::vector<float> scores = {100};
  const std::vector<Identity> owners = {kUnknown};
  const ExpectedActor wanted = unseenAt(0);
  const ExpectedActor other = unseenAt(0.5);
  WantedPerson person{.who = 1, .expected = &wanted};
  EXPECT_EQ(choosePerson(pieces, scores, owners, person).person, 0) << "nobody else is missing";
  const std::array<const ExpectedActor*, 1> missing = {&other};
  person.missing = missing;
  EXPECT_EQ(choosePerson(pieces, scores, owners, person).person, kNoComponent);
}

TEST(ChoosePerson, OfTwoPiecesThatWereThePersonsItIsTheOneAtTheExpectedPlace) {
  std::vector<Component> pieces = {pieceAt(0.9), pieceAt(0)};
  for (Component& piece : pieces) piece.who = 1;
  pieces[0].cells += 100;
  const ExpectedActor wanted = unseenAt(0);
  EXPECT_EQ(choosePerson(pieces, {100, 90}, {kUnknown, kUnknown}, {.who = 1, .expected = &wanted}).person, 1);
  EXPECT_EQ(choosePerson(pieces, {100, 90}, {kUnknown, kUnknown}, {.who = 1}).person, 0) << "anybody: the larger one";
}

TEST(ChoosePerson, NothingFlatInARoomIsAPerson) {
  std::vector<Component> pieces = {pieceAt(0), pieceAt(1)};
  pieces[1].thickness_m = 0.01F;
  const std::vector<float> evidence = {2, 2};
  std::vector<float> scores;
  scoreComponents(pieces, SegmentConfig{}, {.cut_out = false, .min_area_cells = 1, .evidence = &evidence}, scores);
  EXPECT_GT(scores[0], 0);
  EXPECT_EQ(scores[1], 0);
}

}  // namespace
}  // namespace depthmocap

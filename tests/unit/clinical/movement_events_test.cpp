#include "libtracker/clinical/movement_events.h"

#include <gtest/gtest.h>

#include "libtracker/choreography/procedural_motions.h"

namespace depthmocap {
namespace {

std::vector<AnglesRow> rowsOf(const std::string& motion) {
  const MotionClip clip = proceduralMotion(motion, 1);
  const Skeleton skeleton = makeSkeleton(clip.lengths);
  ClinicalAngleReader reader;
  ForwardKinematics fk;
  std::vector<AnglesRow> rows;
  for (std::size_t i = 0; i < clip.poses.size(); ++i) {
    fk.update(skeleton, clip.poses[i]);
    AnglesRow row;
    row.frame = static_cast<std::int64_t>(i);
    row.time_s = static_cast<double>(i) / clip.fps;
    row.state = TrackState::Tracking;
    row.angles = reader.read(fk);
    row.confidence.setOnes();
    row.signals = bodySignals(fk, skeleton);
    rows.push_back(row);
  }
  return rows;
}

std::vector<MovementEvent> of(MovementKind kind, const std::vector<MovementEvent>& events) {
  std::vector<MovementEvent> found;
  for (const MovementEvent& event : events) {
    if (event.kind == kind) found.push_back(event);
  }
  return found;
}

TEST(MovementEvents, AWalkHasStepsOfBothFeetInTurn) {
  const auto events = findMovements(rowsOf("walk"));
  EXPECT_TRUE(of(MovementKind::Jump, events).empty());
  EXPECT_TRUE(of(MovementKind::SitToStand, events).empty());
  ASSERT_GE(events.size(), 4U);
  for (std::size_t i = 1; i < events.size(); ++i) {
    EXPECT_NE(events[i].kind, events[i - 1].kind) << i;
    EXPECT_NEAR(events[i].start_s - events[i - 1].start_s, 0.55, 0.2) << i;
  }
}

TEST(MovementEvents, ASquatIsNeitherAStepNorAJump) {
  const auto events = findMovements(rowsOf("squat"));
  EXPECT_EQ(of(MovementKind::SitToStand, events).size(), events.size());  // where the hips rest below, it is a rise
}

TEST(MovementEvents, JumpsAreFoundWhileBothFeetAreOffTheFloor) {
  const auto jumps = of(MovementKind::Jump, findMovements(rowsOf("jump")));
  ASSERT_FALSE(jumps.empty());
  for (const MovementEvent& jump : jumps) {
    EXPECT_GT(jump.end_s - jump.start_s, 0.1);
    EXPECT_LT(jump.end_s - jump.start_s, 0.8);
  }
}

TEST(MovementEvents, RisingFromASeatIsFound) {
  const auto events = findMovements(rowsOf("sit_and_stand"));
  const auto risings = of(MovementKind::SitToStand, events);
  ASSERT_FALSE(risings.empty());
  for (const MovementEvent& rising : risings) EXPECT_LT(rising.end_s - rising.start_s, 4.0);
  EXPECT_TRUE(of(MovementKind::Jump, events).empty());
}

TEST(MovementEvents, LostFramesInterrupt) {
  auto rows = rowsOf("walk");
  for (AnglesRow& row : rows) row.state = TrackState::Lost;
  EXPECT_TRUE(findMovements(rows).empty());
  EXPECT_TRUE(findMovements({}).empty());
}

}  // namespace
}  // namespace depthmocap

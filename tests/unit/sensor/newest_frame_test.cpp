#include "libtracker/sensor/newest_frame.h"

#include <thread>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr std::chrono::milliseconds kLong{2000};

SensorFrame numbered(int number) {
  SensorFrame frame;
  frame.depth.frame = number;
  return frame;
}

TEST(NewestFrame, GivesTheNewestAndCountsWhatItReplaced) {
  NewestFrame slot;
  for (int i = 0; i < 3; ++i) {
    SensorFrame frame = numbered(i);
    slot.put(frame);
  }
  SensorFrame taken;
  ASSERT_TRUE(slot.take(taken, kLong));
  EXPECT_EQ(taken.depth.frame, 2);
  EXPECT_EQ(slot.replaced(), 2);
  EXPECT_FALSE(slot.take(taken, std::chrono::milliseconds(1))) << "a frame is given once";
}

TEST(NewestFrame, StillGivesTheLastFrameAfterClosing) {
  NewestFrame slot;
  SensorFrame frame = numbered(7);
  slot.put(frame);
  slot.close();
  EXPECT_FALSE(slot.finished());
  ASSERT_TRUE(slot.take(frame, kLong));
  EXPECT_TRUE(slot.finished());
  EXPECT_FALSE(slot.take(frame, kLong));
}

TEST(NewestFrame, LosesNothingOfASourceThatWaits) {
  NewestFrame slot;
  std::thread giver([&slot] {
    for (int i = 0; i < 200; ++i) {
      SensorFrame frame = numbered(i);
      slot.putWhenTaken(frame);
    }
    slot.close();
  });
  int expected = 0;
  SensorFrame frame;
  while (slot.take(frame, kLong)) EXPECT_EQ(frame.depth.frame, expected++);
  giver.join();
  EXPECT_EQ(expected, 200);
  EXPECT_EQ(slot.replaced(), 0);
}

TEST(NewestFrame, ClosingFreesAGiverThatWaits) {
  NewestFrame slot;
  SensorFrame first = numbered(0);
  slot.put(first);
  bool accepted = true;
  std::thread giver([&] {
    SensorFrame second = numbered(1);
    accepted = slot.putWhenTaken(second);
  });
  slot.close();
  giver.join();
  EXPECT_FALSE(accepted);
}

}  // namespace
}  // namespace depthmocap

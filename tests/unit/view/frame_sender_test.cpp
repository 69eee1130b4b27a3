#include "apps/view/frame_sender.h"

#include <atomic>
#include <chrono>
#include <cstring>
#include <future>
#include <nlohmann/json.hpp>
#include <vector>

#include <gtest/gtest.h>

namespace depthmocap {
namespace {

constexpr std::chrono::seconds kPatience{10};

// The number of the frame in a message.
int frameOf(const std::string& message) {
  std::uint32_t length = 0;
  std::memcpy(&length, message.data(), sizeof length);
  return nlohmann::json::parse(message.substr(sizeof length, length))["frame"];
}

void send(FrameSender& sender, int number) {
  TrackedFrame tracked;
  tracked.frame = number;
  const TrackedFrame* const people[] = {&tracked};
  sender.send(DepthImage(64, 48, 1.5F), people, {});
}

// A client that is slow to take a message holds up neither the tracker nor the newest frame.
TEST(FrameSender, SlowDeliveryDropsFramesAndNeverWaits) {
  const CameraModel camera{64, 48, 60, 60, 31.5, 23.5};
  std::promise<void> first_taken;
  std::promise<void> go_on;
  std::promise<void> last_taken;
  std::vector<int> delivered;
  FrameSender sender(camera, [&](const std::string& message) {
    delivered.push_back(frameOf(message));
    if (delivered.size() == 1) {
      first_taken.set_value();
      go_on.get_future().wait();
    }
    if (delivered.back() == 100) last_taken.set_value();
  });
  send(sender, 1);
  ASSERT_EQ(first_taken.get_future().wait_for(kPatience), std::future_status::ready);
  for (int i = 2; i <= 100; ++i) send(sender, i);  // would never end if it waited
  go_on.set_value();
  ASSERT_EQ(last_taken.get_future().wait_for(kPatience), std::future_status::ready);
  EXPECT_EQ(delivered, (std::vector<int>{1, 100}));
}

TEST(FrameSender, EndsWithAFrameUnderWay) {
  const CameraModel camera{64, 48, 60, 60, 31.5, 23.5};
  std::atomic<int> delivered{0};
  for (int i = 0; i < 20; ++i) {
    FrameSender sender(camera, [&](const std::string&) { ++delivered; });
    send(sender, i);
  }
  EXPECT_LE(delivered, 20);
}

}  // namespace
}  // namespace depthmocap

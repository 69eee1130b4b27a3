#include <Eigen/Geometry>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include <gtest/gtest.h>

#include "apps/view/label_runs.h"
#include "apps/view/view_command.h"
#include "apps/view/view_frame.h"
#include "depthmocap/world_frame.h"
#include "libtracker/core/random.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

using nlohmann::json;

TEST(ViewCommand, ReadsEveryCommand) {
  EXPECT_EQ(parseViewCommand(R"({"type":"play"})").action, ViewAction::Play);
  EXPECT_EQ(parseViewCommand(R"({"type":"seek","frame":17})").frame, 17);
  EXPECT_EQ(parseViewCommand(R"({"type":"speed","value":0.25})").speed, 0.25);
  EXPECT_TRUE(parseViewCommand(R"({"type":"record","on":1})").on);
  const ViewCommand lock = parseViewCommand(R"({"type":"lock","x":0.5,"y":0.25})");
  EXPECT_EQ(lock.action, ViewAction::Lock);
  EXPECT_EQ(lock.x, 0.5);
  EXPECT_EQ(lock.y, 0.25);
  const ViewCommand open = parseViewCommand(R"({"type":"open","recording":"folder/take-001","people":3})");
  EXPECT_EQ(open.action, ViewAction::Open);
  EXPECT_EQ(open.recording, "folder/take-001");
  EXPECT_EQ(open.people, 3);
  EXPECT_EQ(parseViewCommand(R"({"type":"open","recording":"x"})").people, 0);
  EXPECT_EQ(parseViewCommand(R"({"type":"close"})").action, ViewAction::Close);
}

TEST(ViewCommand, NamesWhatIsWrong) {
  const std::string deep(3000, '[');
  for (const std::string text :
       {"", "x", "[]", "3", "{}", R"({"type":5})", R"({"type":"format disk"})", R"({"type":"seek"})",
        R"({"type":"seek","frame":-1})", R"({"type":"seek","frame":1e300})", R"({"type":"seek","frame":"1"})",
        R"({"type":"speed","value":0})", R"({"type":"speed","value":null})", R"({"type":"lock","x":2,"y":0})",
        R"({"type":"open"})", R"({"type":"open","recording":7})", R"({"type":"open","recording":"x","people":0})",
        R"({"type":"open","recording":"x","people":7})", R"({"type":"open","recording":"x","people":"1"})"}) {
    EXPECT_NE(errorOf([&] { parseViewCommand(text); }).find("message"), std::string::npos) << text;
  }
  EXPECT_NE(errorOf([&] { parseViewCommand(deep); }), "");
}

TEST(LabelRuns, GiveBackEveryStepthPixel) {
  PartImage labels(101, 47, 0);
  Random random(2);
  for (auto& label : labels.data) label = static_cast<std::uint8_t>(random.below(20) == 0 ? random.below(16) : 0);
  for (const int step : {1, 2, 3}) {
    PartImage again;
    LabelRuns(labels, step).unpack(again);
    ASSERT_EQ(again.width, labels.width);
    for (int y = 0; y < labels.height; y += step) {
      for (int x = 0; x < labels.width; x += step) ASSERT_EQ(again.at(x, y), labels.at(x, y)) << x << ' ' << y;
    }
  }
  PartImage none;
  LabelRuns(PartImage{}, 2).unpack(none);
  EXPECT_TRUE(none.empty());
}

std::string messageOf(ViewFrameEncoder& encoder, const DepthImage& depth, const PartImage& labels,
                      const TrackedFrame& tracked, const ViewFigures& figures) {
  ViewPicture picture;
  encoder.pick(depth, labels, picture);
  return encoder.encode(picture, std::span(&tracked, 1), figures);
}

TEST(ViewFrame, HoldsPictureAndPose) {
  CameraModel camera;
  DepthImage depth(camera.width, camera.height, 0.0F);
  PartImage labels(camera.width, camera.height, 0);
  depth.at(20, 10) = 2.3456F;
  labels.at(20, 10) = 9;
  depth.at(0, 0) = 100.0F;  // farther than the picture can say
  TrackedFrame tracked;
  tracked.frame = 41;
  tracked.state = TrackState::Tracking;
  tracked.joints_camera.col(0) = Eigen::Vector3d(0.1, 0.2, 2.5);
  tracked.markers_camera.confidence[3] = 0.5;
  ViewFrameEncoder encoder(camera);
  ViewFigures figures;
  figures.playback = Playback{.index = 3, .tracked = 5, .total = 9, .playing = true, .speed = 2};
  const std::string message = messageOf(encoder, depth, labels, tracked, figures);
  std::uint32_t length = 0;
  std::memcpy(&length, message.data(), 4);
  EXPECT_EQ(length % 4, 0U);
  const json head = json::parse(message.substr(4, length));
  EXPECT_EQ(head["frame"], 41);
  EXPECT_EQ(head["state"], "tracking");
  EXPECT_EQ(head["joints"][0], (json{0.1, -0.2, -2.5}));
  EXPECT_EQ(head["rotations"].size(), 20U);
  EXPECT_EQ(head["markers"].size(), 1U);
  EXPECT_EQ(head["markers"][0][0], 4);
  EXPECT_EQ(head["playback"]["total"], 9);
  const std::size_t pixels = 320 * 240;
  ASSERT_EQ(message.size(), 4 + length + 3 * pixels);
  std::uint16_t mm = 0;
  std::memcpy(&mm, message.data() + 4 + length + 2 * (5 * 320 + 10), 2);
  EXPECT_EQ(mm, 2346);
  EXPECT_EQ(message[4 + length + 2 * pixels + 5 * 320 + 10], 9);
  std::memcpy(&mm, message.data() + 4 + length, 2);
  EXPECT_EQ(mm, 65535);
}

// A point of the picture and a joint at the same place, as a page draws them.
TEST(ViewFrame, PictureAndJointsOfATiltedCameraMeet) {
  const CameraModel camera{320, 240, 262, 262, 159.5, 119.5};
  TrackedFrame tracked;
  tracked.state = TrackState::Tracking;
  tracked.R_world_camera = Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitX()) * uprightWorldFromCamera();
  const Eigen::Vector3d p_camera(0.1, 0.2, 2.5);
  tracked.joints_camera.col(0) = p_camera;
  ViewFrameEncoder encoder(camera);
  const std::string message = messageOf(encoder, DepthImage(320, 240, 1.0F), PartImage{}, tracked, {});
  std::uint32_t length = 0;
  std::memcpy(&length, message.data(), 4);
  const json head = json::parse(message.substr(4, length));
  const json& t = head["image"]["turn"];
  const Eigen::Quaterniond turn(t[3], t[0], t[1], t[2]);
  const Eigen::Vector3d drawn = turn * Eigen::Vector3d(p_camera.x(), -p_camera.y(), -p_camera.z());
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(drawn[axis], head["joints"][0][static_cast<size_t>(axis)], 2e-4);
}

TEST(ViewFrame, LostFrameHasNoPose) {
  const CameraModel camera{320, 240, 262, 262, 159.5, 119.5};
  ViewFrameEncoder encoder(camera);
  const std::string message = messageOf(encoder, DepthImage(320, 240, 1.0F), PartImage{}, TrackedFrame{}, {});
  std::uint32_t length = 0;
  std::memcpy(&length, message.data(), 4);
  const json head = json::parse(message.substr(4, length));
  EXPECT_EQ(head["state"], "lost");
  EXPECT_FALSE(head.contains("joints"));
  EXPECT_EQ(head["image"]["step"], 1);
}

json headOf(const std::string& message) {
  std::uint32_t length = 0;
  std::memcpy(&length, message.data(), 4);
  return json::parse(message.substr(4, length));
}

TrackedFrame personNumber(int number, TrackState state, double x) {
  TrackedFrame tracked;
  tracked.person = number;
  tracked.state = state;
  tracked.joints_camera.row(0).setConstant(x);
  tracked.confidence.setConstant(0.5);
  return tracked;
}

TEST(ViewFrame, HoldsEverybodyWhoIsThere) {
  const CameraModel camera{320, 240, 262, 262, 159.5, 119.5};
  const std::vector<TrackedFrame> people = {personNumber(1, TrackState::Lost, 0),
                                            personNumber(2, TrackState::Tracking, 1),
                                            personNumber(3, TrackState::Coasting, 2)};
  ViewFrameEncoder encoder(camera);
  ViewPicture picture;
  encoder.pick(DepthImage(320, 240, 1.0F), PartImage{}, picture);
  const json head = headOf(encoder.encode(picture, people, {}));
  EXPECT_EQ(head["state"], "lost") << "the fields of the frame itself are those of the first";
  EXPECT_FALSE(head.contains("joints"));
  ASSERT_EQ(head["people"].size(), 2U);
  EXPECT_EQ(head["people"][0]["person"], 2);
  EXPECT_EQ(head["people"][0]["joints"][5][0], 1.0);
  EXPECT_EQ(head["people"][1]["state"], "coasting");
  for (const char* key : {"joints", "confidence", "root", "rotations", "markers", "stature_m"}) {
    EXPECT_TRUE(head["people"][1].contains(key)) << key;
  }
  const json alone = headOf(encoder.encode(picture, std::span(people).subspan(1, 1), {}));
  EXPECT_FALSE(alone.contains("people"));
  EXPECT_EQ(alone["joints"], head["people"][0]["joints"]);
}

}  // namespace
}  // namespace depthmocap

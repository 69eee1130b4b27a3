#include "libtracker/sensor/driver_table.h"

#include <optional>
#include <string_view>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

// A camera without a device: flat pictures of a wall as far away as its address says, in centimetres.
class WallCamera : public DepthSource {
 public:
  WallCamera(float distance_m, double fps) : distance_m_(distance_m) {
    info_.camera = smallCamera().camera;
    info_.fps = fps;
  }
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  SourceState next(SensorFrame& frame, std::chrono::milliseconds) override {
    frame.depth.depth.reset(info_.camera.width, info_.camera.height, distance_m_);
    return SourceState::Frame;
  }

 private:
  RecordingInfo info_;
  float distance_m_;
};

// All that a new driver has to write.
CameraDriver wallDriver() {
  return {.prefix = "wall",
          .title = "walls",
          .names = {"wall:CM"},
          .remark = "nothing moves",
          .options = {{"--wall-speed", "FACTOR", "How fast it stands still", "1",
                       [](const std::string& text, SourceOptions& options) -> std::string {
                         if (text == "fast") return "'fast' is no number";
                         options.speed = std::stod(text);
                         return "";
                       }}},
          .check = [](std::optional<std::string_view> address) -> std::string {
            return address.value_or("").empty() ? "wall needs a distance: wall:CM" : "";
          },
          .open = [](const std::string& address, const SourceOptions& options) -> std::unique_ptr<DepthSource> {
            return std::make_unique<WallCamera>(std::stof(address) / 100.0F, 30 * options.speed);
          },
          .list =
              [] {
                return std::vector<FoundCamera>{{"wall:250", "The kitchen wall", ""}};
              }};
}

DriverTable tableWithWall() {
  std::vector<CameraDriver> drivers = cameraDrivers().drivers();
  drivers.push_back(wallDriver());
  return DriverTable(drivers);
}

TEST(DriverTable, OpensANewDriversCameraByItsName) {
  SourceOptions options;
  options.speed = 2;
  const auto source = tableWithWall().open("wall:250", options);
  EXPECT_EQ(source->info().fps, 60);
  SensorFrame frame;
  ASSERT_EQ(source->next(frame, std::chrono::milliseconds(0)), SourceState::Frame);
  EXPECT_FLOAT_EQ(frame.depth.depth.at(1, 1), 2.5F);
}

TEST(DriverTable, AsksTheDriverWhetherANameIsGood) {
  const DriverTable table = tableWithWall();
  EXPECT_EQ(table.check("wall:250"), "");
  EXPECT_EQ(table.check("wall:"), "wall needs a distance: wall:CM");
  EXPECT_EQ(table.check("wall"), "wall needs a distance: wall:CM");
  EXPECT_NE(cameraDrivers().check("wall:250"), "") << "the shipped table stays as it is";
  EXPECT_NE(errorOf([&] { static_cast<void>(table.open("wall", {})); }).find("needs a distance"), std::string::npos);
}

TEST(DriverTable, NamesANewDriverInHelpAndErrors) {
  const DriverTable table = tableWithWall();
  EXPECT_TRUE(table.help().ends_with(", or wall:CM (nothing moves)")) << table.help();
  EXPECT_TRUE(table.check("webcam").ends_with(", wall:CM")) << table.check("webcam");
  EXPECT_TRUE(table.listedTitles().ends_with(" and walls")) << table.listedTitles();
}

TEST(DriverTable, ListsANewDriversCameras) {
  const DriverTable only_wall({wallDriver()});
  const std::vector<FoundCamera> found = only_wall.list();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].source, "wall:250");
  EXPECT_EQ(only_wall.help(), "wall:CM (nothing moves)");
  EXPECT_EQ(tableWithWall().drivers().back().options.at(0).flag, "--wall-speed");
}

TEST(DriverTable, KeepsTheShippedNamesAndWords) {
  const DriverTable& table = cameraDrivers();
  EXPECT_EQ(
      table.help(),
      "openni2, openni2:URI, v4l2:/dev/videoN, pipe:-, pipe:PATH (frames that another program sends: standard input, "
      "FIFO or Unix socket), or replay:REC (a recording as if it were a camera)");
  EXPECT_EQ(table.check("webcam"),
            "'webcam' is no source; sources are openni2, openni2:URI, v4l2:/dev/videoN, pipe:-, pipe:PATH, replay:REC");
  EXPECT_EQ(table.check("pipe:"), "pipe needs - (standard input) or a path: pipe:-");
  EXPECT_EQ(table.listedTitles(), "OpenNI2 and V4L2");
  EXPECT_EQ(table.check("openni2"), "");
  EXPECT_EQ(table.check("openni2:"), "openni2: needs a URI, or no colon");
  EXPECT_EQ(table.check("openni2:1d27/0601@1/5"), "");
  EXPECT_EQ(table.check("v4l2:"), "v4l2 needs a device: v4l2:/dev/video0");
  EXPECT_EQ(table.check("replay"), "replay needs a recording: replay:REC");
  EXPECT_EQ(table.check("replay:C:/take"), "");
}

// The driver's option `flag` set to `text`: what it says, and what it has set.
std::pair<std::string, SourceOptions> withOption(std::string_view flag, const std::string& text) {
  SourceOptions options;
  for (const CameraDriver& driver : cameraDrivers().drivers()) {
    for (const DriverOption& option : driver.options) {
      if (option.flag == flag) return {option.set(text, options), options};
    }
  }
  return {"no such option", options};
}

TEST(DriverTable, SetsDriversOptions) {
  EXPECT_EQ(withOption("--pixel-format", "Y10B").second.pixel_format, "Y10B");
  EXPECT_EQ(withOption("--pixel-format", "YUYV").first, "'YUYV' is none of Z16, INZI, Y10B, Y16");
  EXPECT_EQ(withOption("--speed", "0").second.speed, 0);
  for (const char* text : {"", "x", "-1", "1001", "inf"}) EXPECT_NE(withOption("--speed", text).first, "");
}

}  // namespace
}  // namespace depthmocap

#include "apps/terminal/output_check.h"

#include <gtest/gtest.h>

#include "tests/support/made_recording.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

class OutputCheckTest : public testing::Test {
 protected:
  void SetUp() override {
    RecordingInfo info;
    info.camera.width = 8;
    info.camera.height = 6;
    makeRecording(folder_ / "rec", info, 2);
    fs::rename(folder_ / "rec/depth", folder_ / "rec/pictures");
    writeBytes(folder_ / "rec/frames.csv", "frame,time_s,file\n0,0,pictures/000000.png\n1,1,pictures/000001.png\n");
  }
  template <typename Action>
  [[nodiscard]] std::string refusal(Action&& action) const {
    OutputCheck check;
    check.readsRecording((folder_ / "rec").string());
    return errorOf([&] { action(check); });
  }
  TemporaryFolder folder_;
};

TEST_F(OutputCheckTest, KeepsWhatARecordingConsistsOf) {
  fs::create_symlink(folder_ / "rec/frames.csv", folder_ / "link.csv");
  fs::create_hard_link(folder_ / "rec/pictures/000001.png", folder_ / "other.png");
  for (const char* file :
       {"rec/frames.csv", "rec/recording.json", "rec/pictures/000001.png", "link.csv", "other.png"}) {
    const std::string why = refusal([&](OutputCheck& check) { check.writes("--joints", folder_ / file); });
    EXPECT_NE(why.find("is read, and --joints would overwrite it"), std::string::npos) << file;
  }
  for (const char* folder : {"rec", "rec/pictures"}) {
    const std::string why = refusal([&](OutputCheck& check) { check.writesFolder("--labels", folder_ / folder); });
    EXPECT_NE(why.find("is read, and --labels"), std::string::npos) << folder;
  }
}

TEST_F(OutputCheckTest, AllowsResultsBesideIt) {
  writeBytes(folder_ / "rec/joints.csv", "of the last run");
  fs::create_directory(folder_ / "rec/labels");
  EXPECT_EQ(refusal([&](OutputCheck& check) {
              check.writes("--joints", folder_ / "rec/joints.csv");
              check.writesFolder("--labels", folder_ / "rec/labels");
              check.writes("--pose", "");
            }),
            "");
  EXPECT_EQ(readBytes(folder_ / "rec/joints.csv"), "of the last run");
}

TEST_F(OutputCheckTest, RefusesTwoOutputsOfOneName) {
  const auto both = [&](const fs::path& joints, const fs::path& pose) {
    return refusal([&](OutputCheck& check) {
      check.writes("--joints", joints);
      check.writes("--pose", pose);
    });
  };
  fs::create_directory(folder_ / "a");
  EXPECT_NE(both(folder_ / "x.csv", folder_ / "x.csv").find("named by --joints and by --pose"), std::string::npos);
  EXPECT_NE(both(folder_ / "x.csv", folder_ / "a/../x.csv"), "");
  fs::create_symlink("x.csv", folder_ / "y.csv");
  EXPECT_NE(both(folder_ / "x.csv", folder_ / "y.csv"), "");
  EXPECT_NE(both("x.csv", fs::current_path() / "x.csv"), "");
  EXPECT_EQ(both("/dev/null", "/dev/null"), "");
  EXPECT_EQ(both(folder_ / "x.csv", folder_ / "z.csv"), "");
}

TEST_F(OutputCheckTest, RefusesWhatCannotBeWritten) {
  EXPECT_NE(refusal([&](OutputCheck& check) { check.writes("--bvh", folder_ / "no/a.bvh"); }).find("create its folder"),
            std::string::npos);
  EXPECT_NE(refusal([&](OutputCheck& check) { check.writes("--bvh", folder_.path()); }), "");
  EXPECT_NE(refusal([&](OutputCheck& check) { check.writesFolder("--labels", folder_ / "rec/recording.json"); }), "");
}

}  // namespace
}  // namespace depthmocap

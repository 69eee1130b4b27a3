#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>

#include "libtracker/recording/track_files.h"
#include "tests/support/recording_excerpt.h"
#include "tests/support/run_program.h"
#include "tests/support/served_camera.h"

// The commands live and record from outside; cameras through the real OpenNI2 runtime (tests/drivers).
namespace depthmocap {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class LiveCommand : public testing::Test {
 protected:
  LiveCommand() {
    setenv("LD_LIBRARY_PATH", DEPTHMOCAP_OPENNI, 1);  // the runtime with our driver, for the program
    copyExcerpt("walk", 20, folder_ / "walk");
  }
  ~LiveCommand() override { unsetenv("LD_LIBRARY_PATH"); }
  [[nodiscard]] std::string at(const std::string& name) const { return quoted(folder_ / name); }
  [[nodiscard]] json stats(const std::string& name) const { return json::parse(readBytes(folder_ / name)); }

  TemporaryFolder folder_;
};

TEST_F(LiveCommand, TracksARecordingAsIfItWereACamera) {
  const ProgramResult result = runProgram("live --source replay:" + at("walk") + " --joints " + at("j.csv") +
                                          " --record " + at("rec") + " --stats " + at("s.json"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  const json live = stats("s.json").at("live");
  EXPECT_EQ(live.at("received"), 20);
  EXPECT_EQ(live.at("recorded"), 20) << "the recorder gets what the tracker skips, too";
  EXPECT_EQ(live.at("not_recorded"), 0);
  EXPECT_GT(live.at("latency_ms").at("p50").get<double>(), 0);
  const std::size_t rows = readJointsFile(folder_ / "j.csv").size();
  EXPECT_EQ(rows + live.at("skipped").get<std::size_t>(), 20U);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(readBytes(folder_ / ("rec/depth/" + framePng(i))), readBytes(folder_ / ("walk/depth/" + framePng(i))));
  }
}

TEST_F(LiveCommand, WithoutPaceGivesWhatReplayGives) {
  ASSERT_EQ(runProgram("live --speed 0 --source replay:" + at("walk") + " --joints " + at("live.csv")).exit_code, 0);
  ASSERT_EQ(runProgram("replay --look-ahead 0 --passes 1 " + at("walk") + " --joints " + at("replay.csv")).exit_code,
            0);
  EXPECT_EQ(readBytes(folder_ / "live.csv"), readBytes(folder_ / "replay.csv"));
}

TEST_F(LiveCommand, TracksOnAfterTheCableWasPulled) {
  setenv("DEPTHMOCAP_TEST_FAULTS", "unplug:10:300", 1);
  setenv("DEPTHMOCAP_TEST_RECORDING", (folder_ / "walk").c_str(), 1);
  const ProgramResult result = runProgram("live --source openni2 --seconds 3 --joints " + at("j.csv") + " --record " +
                                          at("rec") + " --stats " + at("s.json"));
  unsetenv("DEPTHMOCAP_TEST_RECORDING");
  unsetenv("DEPTHMOCAP_TEST_FAULTS");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.errors.find("the camera was unplugged; waiting"), std::string::npos) << result.errors;
  EXPECT_NE(result.errors.find("the camera is back"), std::string::npos) << result.errors;
  EXPECT_GE(stats("s.json").at("live").at("returns"), 1);
  const auto rows = readJointsFile(folder_ / "j.csv");  // checks that numbers and times grow
  EXPECT_GE(rows.back().frame, 10) << "frames of the second time";
  EXPECT_GE(openRecording(folder_ / "rec")->frameCount(), 12U);
}

TEST_F(LiveCommand, TakesTheFirstCameraWhereNoneIsNamed) {
  setenv("DEPTHMOCAP_TEST_RECORDING", (folder_ / "walk").c_str(), 1);
  const ProgramResult result = runProgram("live --view --view-port 0 --seconds 0.3 --joints " + at("j.csv"));
  unsetenv("DEPTHMOCAP_TEST_RECORDING");
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors.find("no camera yet"), std::string::npos) << result.errors;
  EXPECT_GT(readJointsFile(folder_ / "j.csv").size(), 3U);
}

// Starts the program on a camera that serves the recording, and ends it by a signal once the tenth frame is recorded.
int endedBySignal(const fs::path& served, const fs::path& recording, std::vector<std::string> arguments, int number) {
  setenv("DEPTHMOCAP_TEST_RECORDING", served.c_str(), 1);
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    if (freopen("/dev/null", "w", stderr) == nullptr) _exit(98);
    execv(DEPTHMOCAP_PROGRAM, argv.data());
    _exit(99);
  }
  unsetenv("DEPTHMOCAP_TEST_RECORDING");
  const fs::path tenth = recording / "depth/000010.png";
  for (int i = 0; i < 600 && !fs::exists(tenth); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  kill(child, number);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST_F(LiveCommand, CtrlCCompletesEveryFile) {
  const int status = endedBySignal(folder_ / "walk", folder_ / "rec",
                                   {"depthmocap", "live", "--source", "openni2", "--joints",
                                    (folder_ / "j.csv").string(), "--record", (folder_ / "rec").string()},
                                   SIGINT);
  ASSERT_TRUE(WIFEXITED(status)) << "ended by signal " << WTERMSIG(status);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_FALSE(readJointsFile(folder_ / "j.csv").empty());
  EXPECT_TRUE(json::parse(readBytes(folder_ / "rec/recording.json")).contains("recorder"));
  EXPECT_GE(openRecording(folder_ / "rec")->frameCount(), 10U);
}

TEST_F(LiveCommand, LeavesARecordingThatCanBeReadWhenItIsKilled) {
  const int status =
      endedBySignal(folder_ / "walk", folder_ / "rec",
                    {"depthmocap", "record", "--source", "openni2", "--out", (folder_ / "rec").string()}, SIGKILL);
  ASSERT_TRUE(WIFSIGNALED(status));
  const auto recording = openRecording(folder_ / "rec");
  EXPECT_GE(recording->frameCount(), 9U) << "all but what was being written";
  DepthFrame frame;
  for (std::size_t i = 0; i < recording->frameCount(); ++i) EXPECT_NO_THROW(recording->read(i, frame)) << i;
}

TEST_F(LiveCommand, EndsWhenAnOutputFails) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
  for (const char* pace : {"0", "1"}) {
    const ProgramResult result =
        runProgram(std::string("live --joints /dev/full --source replay:") + at("walk") + " --speed " + pace);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.errors.find("/dev/full"), std::string::npos) << result.errors;
  }
}

TEST_F(LiveCommand, ListsTheCamerasThatAreThere) {
  setenv("DEPTHMOCAP_TEST_RECORDING", (folder_ / "walk").c_str(), 1);
  const ProgramResult result = runProgram("cameras");
  unsetenv("DEPTHMOCAP_TEST_RECORDING");
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.output.find("openni2:depthmocap-test/1@1  depthmocap Served recording"), std::string::npos)
      << result.output;
}

TEST_F(LiveCommand, RecordsSoManyFrames) {
  const ProgramResult result =
      runProgram("record --speed 0 --frames 7 --source replay:" + at("walk") + " --out " + at("rec"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(openRecording(folder_ / "rec")->frameCount(), 7U);
}

TEST_F(LiveCommand, RecordsSoManySeconds) {
  const ProgramResult result =
      runProgram("record --speed 0 --seconds 0.5 --source replay:" + at("walk") + " --out " + at("rec"));
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(openRecording(folder_ / "rec")->frameCount(), 15U);
}

TEST_F(LiveCommand, RefusesToOverwriteARecording) {
  const ProgramResult result = runProgram("record --source replay:" + at("walk") + " --out " + at("walk"));
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.errors.find("not overwritten"), std::string::npos) << result.errors;
}

TEST_F(LiveCommand, SaysWhatIsWrongWithASource) {
  const auto fails = [](const std::string& arguments, int exit_code, const std::string& text) {
    const ProgramResult result = runProgram(arguments);
    EXPECT_EQ(result.exit_code, exit_code) << arguments;
    EXPECT_NE(result.errors.find(text), std::string::npos) << result.errors;
  };
  fails("live --source openni2", 1, "no camera found");
  fails("live --source openni2:1d27/0601@1/4", 1, "check that it is plugged in");
  fails("live --source v4l2:/dev/no_such_video", 1, "check that the camera is plugged in");
  fails("live --source v4l2:/dev/null", 1, "is no camera");
  fails("live --source replay:/no/such/recording", 1, "there is no such recording");
  fails("live --source webcam", 2, "sources are");
  fails("live", 2, "--source");
}

}  // namespace
}  // namespace depthmocap

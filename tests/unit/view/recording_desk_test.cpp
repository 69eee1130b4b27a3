#include "apps/view/recording_desk.h"

#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include <gtest/gtest.h>

#include "depthmocap/error.h"
#include "tests/support/connection.h"
#include "tests/support/made_recording.h"
#include "tests/support/page_files.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

// Writes a file of the format and ends when it may, or is told to.
class FakeTracker : public RecordingTracker {
 public:
  [[nodiscard]] const std::vector<ExportFormat>& formats() const override { return formats_; }
  void track(const TrackTask& task, FrameSink&, const ReplayHooks& hooks) override {
    ++begun;
    people = task.people;
    for (int i = 0; i < 1000 && !may_end && !hooks.stopped(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (fails) throw Error("nobody was tracked", task.name);
    writeBytes(task.folder / (task.name + ".bvh"), "motion of " + task.recording.path.filename().string());
    ++ended;
  }
  std::atomic<bool> may_end{true};
  std::atomic<bool> fails{false};
  std::atomic<int> begun{0};
  std::atomic<int> ended{0};
  std::atomic<int> people{0};

 private:
  std::vector<ExportFormat> formats_ = {{"bvh", "BVH", ".bvh"}};
};

class Desk : public testing::Test {
 protected:
  Desk() {
    setenv("DEPTHMOCAP_SHARE", folder_.path().c_str(), 1);
    makeRecording(folder_ / "mine/take", smallCamera(), 4);
    makeRecording(folder_ / "mine/other", smallCamera(), 4);
    makePageFiles(folder_ / "page");
    page_ = std::make_unique<LivePage>(WebServerConfig{.port = 0, .token = "secret"}, folder_ / "page",
                                       LivePageInfo{"idle", "no camera", {}});
    desk_ = std::make_unique<RecordingDesk>(*page_, RecordingShelf(folder_ / "mine"), tracker_, 2);
    page_->start();
  }
  ~Desk() override {
    desk_.reset();
    unsetenv("DEPTHMOCAP_SHARE");
  }
  [[nodiscard]] std::string get(const std::string& target, bool with_token = true) const {
    const std::uint16_t port = page_->server().port();
    const Connection connection(port);
    connection.send("GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                    "\r\nConnection: close\r\n" + (with_token ? "Authorization: Bearer secret\r\n" : "") + "\r\n");
    return connection.receive(1 << 20);
  }
  [[nodiscard]] json job() const {
    const std::string answer = get("/recordings");
    return json::parse(answer.substr(answer.find("\r\n\r\n") + 4))["job"];
  }
  // Once the desk has got there.
  void expectState(const std::string& state) const {
    for (int i = 0; i < 500 && job()["state"] != state; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_EQ(job()["state"], state) << job();
  }
  // What the page's stream answers to a message of a client.
  void say(const json& message) const {
    const std::uint16_t port = page_->server().port();
    const std::string text = message.dump();
    std::string frame = "\x81";
    frame += static_cast<char>(0x80 | text.size());
    frame += std::string(4, '\0') + text;
    const Connection connection(port);
    connection.send("GET /stream?token=secret HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
                    "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    (void)connection.receive(10);
    connection.send(frame);
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  void open(const std::string& id) const { say({{"type", "open"}, {"recording", id}}); }
  void close() const { say({{"type", "close"}}); }

  TemporaryFolder folder_;
  FakeTracker tracker_;
  std::unique_ptr<LivePage> page_;
  std::unique_ptr<RecordingDesk> desk_;
};

TEST_F(Desk, TracksARecordingAndSendsItsFiles) {
  open("folder/take");
  expectState("done");
  EXPECT_EQ(tracker_.people, 2) << "as the command was told";
  EXPECT_TRUE(page_->isOpened());
  EXPECT_EQ(job()["files"], json::parse(R"([{"format":"bvh","name":"take.bvh","bytes":14}])"));
  EXPECT_NE(get("/export?file=take.bvh").find("\r\n\r\nmotion of take"), std::string::npos);
  close();
  expectState("none");
  EXPECT_FALSE(page_->isOpened());
  EXPECT_EQ(get("/export?file=take.bvh").rfind("HTTP/1.1 400", 0), 0U);
}

TEST_F(Desk, NeedsTheToken) {
  for (const char* target : {"/recordings", "/export?file=take.bvh"}) {
    EXPECT_EQ(get(target, false).rfind("HTTP/1.1 403", 0), 0U) << target;
  }
}

TEST_F(Desk, RefusesNamesThatItDoesNotList) {
  open("folder/take");
  expectState("done");
  writeBytes(folder_ / "secret.bvh", "secret");
  for (const std::string name :
       {"", "../secret.bvh", "..%2Fsecret.bvh", "/etc/passwd", "take", "take.bvh/", "take.bvh%00", "."}) {
    const std::string answer = get("/export?file=" + name);
    EXPECT_EQ(answer.rfind("HTTP/1.1 400", 0), 0U) << name;
    EXPECT_NE(answer.find("there is no such file"), std::string::npos) << answer;
  }
  for (const char* id : {"", "../secret", "folder/../page", "/etc", "folder/none"}) {
    open(id);
    expectState("failed");
    EXPECT_NE(job()["problem"].get<std::string>().find("no such recording"), std::string::npos) << job();
  }
  EXPECT_EQ(tracker_.begun, 1);
}

TEST_F(Desk, TracksOneAtATime) {
  tracker_.may_end = false;
  open("folder/take");
  expectState("tracking");
  for (int i = 0; i < 3; ++i) open("folder/other");
  EXPECT_EQ(job()["recording"], "folder/take");
  EXPECT_EQ(tracker_.begun, 1);
  close();
  expectState("none");
  EXPECT_EQ(tracker_.begun, 1);
  EXPECT_FALSE(page_->isOpened());
  tracker_.may_end = true;
  open("folder/other");
  expectState("done");
  EXPECT_EQ(tracker_.begun, 2);
}

TEST_F(Desk, SaysWhyTrackingFailed) {
  tracker_.fails = true;
  open("folder/take");
  expectState("failed");
  EXPECT_EQ(job()["problem"], "take: nobody was tracked");
  writeBytes(folder_ / "mine/other/recording.json", "{");
  open("folder/other");
  for (int i = 0; i < 300 && job()["recording"] != "folder/other"; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  expectState("failed");
  EXPECT_NE(job()["problem"].get<std::string>().find("is not valid JSON"), std::string::npos) << job();
}

TEST_F(Desk, EndsWhileARecordingIsTracked) {
  tracker_.may_end = false;
  open("folder/take");
  expectState("tracking");
  desk_.reset();
  EXPECT_EQ(tracker_.ended, 1);
}

}  // namespace
}  // namespace depthmocap

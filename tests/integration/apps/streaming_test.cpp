#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include "libtracker/recording/track_files.h"
#include "tests/support/connection.h"
#include "tests/support/recording_excerpt.h"
#include "tests/support/run_program.h"

extern char** environ;

namespace depthmocap {
namespace {

// A program that runs until it is told to end; its stderr goes to a file.
class BackgroundProgram {
 public:
  BackgroundProgram(const std::string& arguments, std::filesystem::path errors) : errors_(std::move(errors)) {
    std::string shell = "exec \"" DEPTHMOCAP_PROGRAM "\" " + arguments + " 2>" + quoted(errors_);
    std::string sh = "sh";
    std::string option = "-c";
    char* command[] = {sh.data(), option.data(), shell.data(), nullptr};
    EXPECT_EQ(posix_spawn(&process_, "/bin/sh", nullptr, nullptr, command, environ), 0);
  }
  // What follows `word` on stderr, to the end of its line; waits for it.
  [[nodiscard]] std::string waitFor(const std::string& word) const {
    for (int i = 0; i < 600; ++i) {
      const std::string text = readBytes(errors_);
      const std::size_t at = text.find(word);
      const std::size_t end = at == std::string::npos ? at : text.find('\n', at);
      if (end != std::string::npos) return text.substr(at + word.size(), end - at - word.size());
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ADD_FAILURE() << word << " did not come: " << readBytes(errors_);
    return {};
  }
  // The exit code after Ctrl-C.
  int interrupt() const {
    kill(process_, SIGINT);
    int status = 0;
    waitpid(process_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  std::filesystem::path errors_;
  pid_t process_ = 0;
};

class Streaming : public testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const { return quoted(folder_ / name); }
  [[nodiscard]] static std::string recording(const std::string& name) { return quoted(bundledRecording(name)); }
  void replay(const std::string& options) const {
    const ProgramResult result = runProgram("replay " + recording("squat") + " --last 19 " + options);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
  }
  TemporaryFolder folder_;
};

std::string lineWith(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

TEST_F(Streaming, BvhInCentimetresWithRigidBones) {
  replay("--bvh " + at("m.bvh"));
  replay("--bvh " + at("cm.bvh") + " --bvh-unit cm");
  const std::string metres = readBytes(folder_ / "m.bvh");
  const std::string centimetres = readBytes(folder_ / "cm.bvh");
  const auto hip = [](const std::string& bvh) {
    const std::string line = lineWith(bvh.substr(bvh.find("LeftLeg")), "OFFSET");
    return std::stod(line.substr(line.find(' ', 7)));
  };
  EXPECT_NEAR(hip(centimetres), 100 * hip(metres), 1e-3);
  EXPECT_EQ(lineWith(metres, "Frame Time:").substr(0, 19), "Frame Time: 0.03333");
  EXPECT_EQ(metres.find("CHANNELS 6", metres.find("CHANNELS 6") + 1), std::string::npos);
}

TEST_F(Streaming, SmoothingCalmsAllOutputsAlike) {
  replay("--joints " + at("plain.csv") + " --gltf " + at("plain.glb") + " --look-ahead 0");
  replay("--joints " + at("calm.csv") + " --gltf " + at("calm.glb") + " --look-ahead 0 --smooth 1");
  replay("--joints " + at("again.csv") + " --gltf " + at("again.glb") + " --look-ahead 0 --smooth 1 --threads 1");
  EXPECT_EQ(readBytes(folder_ / "calm.csv"), readBytes(folder_ / "again.csv"));
  EXPECT_EQ(readBytes(folder_ / "calm.glb"), readBytes(folder_ / "again.glb"));
  EXPECT_NE(readBytes(folder_ / "calm.glb"), readBytes(folder_ / "plain.glb"));
  const auto roughness = [&](const char* name) {
    const auto rows = readJointsFile(folder_ / name);
    double sum = 0;
    for (std::size_t i = 2; i < rows.size(); ++i) {
      sum += (rows[i].p_camera - 2 * rows[i - 1].p_camera + rows[i - 2].p_camera).norm();
    }
    return sum;
  };
  EXPECT_LT(roughness("calm.csv"), 0.7 * roughness("plain.csv"));
}

TEST_F(Streaming, WrongValuesAreWrongUsage) {
  for (const char* option : {"--smooth 2", "--smooth x", "--bvh-unit inch", "--view-port 70000"}) {
    EXPECT_EQ(runProgram("replay " + recording("squat") + " " + option).exit_code, 2) << option;
  }
  EXPECT_EQ(runProgram("replay " + recording("squat") + " --vmc nowhere").exit_code, 1);
  EXPECT_EQ(runProgram("serve --address example.com --port 0").exit_code, 1);
}

TEST_F(Streaming, InterruptedReplayCompletesItsFiles) {
  // At the pace of the recording, because of --vmc.
  const BackgroundProgram program("replay --passes 1 " + recording("walk") +
                                      " --view --view-port 0 --vmc localhost:9 --joints " + at("j.csv") + " --bvh " +
                                      at("m.bvh") + " --gltf " + at("m.glb"),
                                  folder_ / "errors");
  EXPECT_EQ(program.waitFor("view: ").rfind("http://127.0.0.1:", 0), 0U);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_EQ(program.interrupt(), 0);
  const auto rows = readJointsFile(folder_ / "j.csv");
  EXPECT_GT(rows.size(), 5U);
  EXPECT_LT(rows.size(), 120U);
  EXPECT_EQ(std::stoul(lineWith(readBytes(folder_ / "m.bvh"), "Frames:").substr(7)), rows.size());
  EXPECT_EQ(readBytes(folder_ / "m.glb").substr(0, 4), "glTF");
}

TEST_F(Streaming, ServePosesABodyOverHttp) {
  const BackgroundProgram program("serve --port 0", folder_ / "errors");
  const std::string port = program.waitFor("http://127.0.0.1:");
  const auto post = [&](const std::string& body) {
    const Connection connection(static_cast<std::uint16_t>(std::stoi(port)));
    connection.send("POST /ik HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(std::stoi(port)) +
                    "\r\nConnection: close\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    const std::string answer = connection.receive(1 << 20);
    return std::pair(answer.substr(0, 12), nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n") + 4)));
  };
  const auto [status, answer] =
      post(R"({"targets": {"left_wrist": [0.5, 1.2, 0.3], "head": [0, 1.6, 0]}, "prior": "vae"})");
  EXPECT_EQ(status, "HTTP/1.1 200");
  EXPECT_LT(answer["residual_m"].get<double>(), 0.05);
  EXPECT_EQ(answer["joints"]["left_wrist"].size(), 3U);
  EXPECT_EQ(answer["rotations"]["lradius"].size(), 4U);
  const auto [bad_status, bad] = post("{}");
  EXPECT_EQ(bad_status, "HTTP/1.1 400");
  EXPECT_TRUE(bad["error"].is_string());
  EXPECT_EQ(post(std::string(100000, ' ')).first, "HTTP/1.1 413");
  EXPECT_EQ(program.interrupt(), 0);
}

// A client of the page: its stream, and what it gets over HTTP.
class PageClient {
 public:
  explicit PageClient(const std::string& port)
      : port_(static_cast<std::uint16_t>(std::stoi(port))),
        host_("127.0.0.1:" + std::to_string(port_)),
        stream_(port_) {
    stream_.send("GET /stream HTTP/1.1\r\nHost: " + host_ +
                 "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                 "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    (void)stream_.receive(10);  // it is a stream from here on
  }
  void say(const std::string& text) const {
    std::string frame = "\x81";
    frame += static_cast<char>(0x80 | text.size());
    stream_.send(frame + std::string(4, '\0') + text);
  }
  [[nodiscard]] std::string get(const std::string& target) const {
    const Connection connection(port_);
    connection.send("GET " + target + " HTTP/1.1\r\nHost: " + host_ + "\r\nConnection: close\r\n\r\n");
    const std::string answer = connection.receive(1 << 26);
    return answer.substr(answer.find("\r\n\r\n") + 4);
  }
  // Once the recording that was opened is tracked.
  [[nodiscard]] nlohmann::json job() const {
    for (int i = 0; i < 600; ++i) {
      const nlohmann::json job = nlohmann::json::parse(get("/recordings"))["job"];
      if (job["state"] == "done" || job["state"] == "failed") return job;
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    ADD_FAILURE() << "the recording was not tracked";
    return {};
  }

 private:
  std::uint16_t port_;
  std::string host_;
  Connection stream_;
};

TEST_F(Streaming, ThePageExportsWhatReplayWrites) {
  copyExcerpt("squat", 20, folder_ / "mine/squat");
  const BackgroundProgram program("serve --port 0 --folder " + at("mine"), folder_ / "errors");
  const PageClient client(program.waitFor("http://127.0.0.1:"));
  client.say(R"({"type":"open","recording":"folder/squat"})");
  const nlohmann::json job = client.job();
  ASSERT_EQ(job["state"], "done") << job;
  std::string options;
  std::filesystem::create_directories(folder_ / "out");
  for (const auto& file : job["files"]) {
    options += " --" + file["format"].get<std::string>() + " " + at("out/" + file["name"].get<std::string>());
  }
  const ProgramResult result = runProgram("replay " + at("mine/squat") + options);
  ASSERT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(job["files"].size(), 9U);
  for (const auto& file : job["files"]) {
    const std::string name = file["name"];
    const std::string sent = client.get("/export?file=" + name);
    EXPECT_EQ(sent.size(), file["bytes"].get<std::size_t>()) << name;
    EXPECT_TRUE(sent == readBytes(folder_ / ("out/" + name))) << name;
  }
  EXPECT_EQ(program.interrupt(), 0);
}

TEST_F(Streaming, LiveWithoutACameraOffersRecordings) {
  EXPECT_EQ(runProgram("live").exit_code, 2);
  const BackgroundProgram program("live --view --view-port 0 --view-folder " + at("mine"), folder_ / "errors");
  const PageClient client(program.waitFor("http://127.0.0.1:"));
  EXPECT_EQ(nlohmann::json::parse(client.get("/cameras"))["waits"], true);
  EXPECT_EQ(nlohmann::json::parse(client.get("/recordings"))["recordings"].size(), 3U);
  client.say(R"({"type":"open","recording":"bundled/walk"})");
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_EQ(program.interrupt(), 0) << "while a recording is tracked";
}

TEST_F(Streaming, PageDoesNotChangeFiles) {
  replay("--joints " + at("plain.csv"));
  const BackgroundProgram program(
      "replay " + recording("squat") + " --last 19 --view --view-port 0 --joints " + at("viewed.csv"),
      folder_ / "errors");
  EXPECT_EQ(program.waitFor("the page stays"), " until Ctrl-C");
  EXPECT_EQ(program.interrupt(), 0);
  EXPECT_EQ(readBytes(folder_ / "plain.csv"), readBytes(folder_ / "viewed.csv"));
}

}  // namespace
}  // namespace depthmocap

// Runs inside the guest: `depthmocap live` on a real kernel's /dev/video device, to which pictures are written at a
// camera's pace for minutes. No picture may be lost on the way, and memory must not grow. Before that, cameras that the
// program cannot use.
//
// Usage: guest_live LOOPBACK RECORDING CAMERA.json ...; the program is /depthmocap.
// Environment: guest_seconds (600), guest_fps (30).
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <sys/wait.h>

#include "libtracker/recording/recording_header.h"
#include "tests/qemu/feeder.h"

namespace depthmocap {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kProgram = "/depthmocap";
constexpr const char* kStats = "/tmp/stats.json";
constexpr const char* kErrors = "/tmp/errors.txt";
constexpr int kPictures = 100;
constexpr std::chrono::seconds kSample(10);
constexpr int kWarm = 6;           // samples until all memory is there
constexpr double kGrowth = 0.002;  // of the memory, in ten minutes: none

double fromEnvironment(const char* name, double otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : std::stod(text);
}

std::string contents(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

// Written at a fixed rate, to and fro. One that comes too late moves those after it: a camera sends no bursts.
class PacedFeeder {
 public:
  PacedFeeder(const Feeder& feeder, std::vector<Picture16> pictures, double fps)
      : feeder_(feeder), pictures_(std::move(pictures)), period_(std::chrono::nanoseconds(std::lround(1e9 / fps))) {
    feeder_.send(pictures_[0]);  // from now on it can be opened
    thread_ = std::thread([this] { run(); });
  }
  ~PacedFeeder() {
    stopping_ = true;
    thread_.join();
  }
  PacedFeeder(const PacedFeeder&) = delete;
  PacedFeeder& operator=(const PacedFeeder&) = delete;
  [[nodiscard]] long written() const { return written_; }
  [[nodiscard]] long late() const { return late_; }  // by more than a picture's time

 private:
  void run() {
    Clock::time_point due = Clock::now();
    while (!stopping_) {
      due += period_;
      std::this_thread::sleep_until(due);
      if (Clock::now() > due + period_) {
        due = Clock::now();
        ++late_;
      }
      const auto last = static_cast<long>(pictures_.size()) - 1;
      const long step = written_ % (2 * last);
      feeder_.send(pictures_[static_cast<std::size_t>(std::min(step, 2 * last - step))]);
      ++written_;
    }
  }
  const Feeder& feeder_;
  std::vector<Picture16> pictures_;
  std::chrono::nanoseconds period_;
  std::atomic<bool> stopping_{false};
  std::atomic<long> written_{1};
  std::atomic<long> late_{0};
  std::thread thread_;
};

pid_t start(std::vector<std::string> arguments, uid_t user, const char* errors) {
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  require(child >= 0, "cannot start a process");
  if (child > 0) return child;
  if (errors != nullptr && freopen(errors, "w", stderr) == nullptr) _exit(98);
  if (user != 0 && setuid(user) != 0) _exit(97);
  execv(kProgram, argv.data());
  _exit(99);
}

int exitCode(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

void refuses(const std::string& device, uid_t user, const std::string& text) {
  int status = 0;
  waitpid(start({"depthmocap", "live", "--source", "v4l2:" + device}, user, kErrors), &status, 0);
  const std::string message = contents(kErrors);
  std::printf("live: exit code %d: %s", exitCode(status), message.c_str());
  require(exitCode(status) == 1 && message.find(text) != std::string::npos, "that should have been: " + text);
}

void checkRefusals(const std::string& device, const CameraModel& camera) {
  constexpr uid_t kNobody = 65534;
  refuses("/dev/video5", 0, "check that the camera is plugged in");
  for (const std::uint32_t fourcc : {V4L2_PIX_FMT_YUYV, V4L2_PIX_FMT_GREY}) {
    const Feeder feeder(device, camera, fourcc);
    feeder.send(Picture16(camera.width, camera.height / 2, 0));  // of either size: the rest is not looked at
    refuses(device, 0, fourcc == V4L2_PIX_FMT_GREY ? "it has GREY" : "it has YUYV");
    if (fourcc == V4L2_PIX_FMT_GREY) refuses(device, kNobody, "group 'video'");
  }
}

long residentKb(pid_t process) {
  const std::string status = contents("/proc/" + std::to_string(process) + "/status");
  const std::size_t at = status.find("VmRSS:");
  return at == std::string::npos ? 0 : std::stol(status.substr(at + 6));
}

// Until it ends; its memory each ten seconds.
std::vector<long> watch(pid_t process, const PacedFeeder& feeder) {
  std::vector<long> samples;
  int status = 0;
  Clock::time_point due = Clock::now() + kSample;
  while (waitpid(process, &status, WNOHANG) == 0) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    if (Clock::now() < due) continue;
    due += kSample;
    samples.push_back(residentKb(process));
    std::printf("\nlive: %zu s, %ld kB, %ld pictures written, %ld of them late\n", samples.size() * 10, samples.back(),
                feeder.written(), feeder.late());
  }
  require(exitCode(status) == 0, "depthmocap live ended with " + std::to_string(exitCode(status)));
  return samples;
}

void check(const nlohmann::json& stats, const std::vector<long>& samples) {
  const nlohmann::json& live = stats.at("live");
  const long received = live.at("received");
  const long tracked = stats.at("frames");
  require(live.at("missing") == 0 && live.at("damaged") == 0, "pictures were lost on the way");
  require(received - tracked - live.at("skipped").get<long>() <= 1, "pictures are neither tracked nor skipped");
  require(2 * stats.at("tracked").get<long>() > tracked, "nobody was tracked");
  if (samples.size() <= kWarm) return;
  const auto first = static_cast<double>(samples[kWarm]);
  require(static_cast<double>(samples.back()) <= first * (1 + kGrowth), "memory grows");
}

void runLive(const std::string& device, const std::string& recording, const std::string& camera_file) {
  const CameraModel camera = readRecordingHeader(camera_file).camera;
  checkRefusals(device, camera);
  const Feeder feeder(device, camera);
  const PacedFeeder pace(feeder, readPictures(recording, camera, kPictures), fromEnvironment("guest_fps", 30));
  const std::string seconds = std::to_string(fromEnvironment("guest_seconds", 600));
  const pid_t program = start({"depthmocap", "live", "--source", "v4l2:" + device, "--camera", camera_file, "--threads",
                               "1", "--seconds", seconds, "--stats", kStats},
                              0, nullptr);
  const std::vector<long> samples = watch(program, pace);
  const nlohmann::json stats = nlohmann::json::parse(contents(kStats));
  std::printf("live: written %ld, late %ld, frames %s, tracked %s, %s\nlive: stages %s\n", pace.written(), pace.late(),
              stats.at("frames").dump().c_str(), stats.at("tracked").dump().c_str(), stats.at("live").dump().c_str(),
              stats.at("stage_ms").dump().c_str());
  check(stats, samples);
}

}  // namespace
}  // namespace depthmocap

int main(int argc, char** argv) {
  try {
    depthmocap::require(argc >= 4, "usage: guest_live LOOPBACK RECORDING CAMERA.json");
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    depthmocap::runLive(argv[1], argv[2], argv[3]);
    std::puts("GUEST OK");
    return 0;
  } catch (const std::exception& error) {
    std::printf("GUEST FAILED: %s\n", error.what());
    return 1;
  }
}

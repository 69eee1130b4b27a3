#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "libtracker/sensor/open_source.h"
#include "tests/support/temporary_folder.h"

namespace depthmocap {
namespace {

constexpr std::chrono::milliseconds kWait{2000};
constexpr std::chrono::milliseconds kMoment{20};
constexpr int kPixels = 4 * 3;

const std::string kHeader =
    R"({"format":"depthmocap-recording","version":1,"width":4,"height":3,"fps":30,"depth_unit_m":0.002,)"
    R"("intrinsics":{"fx":4,"fy":4,"cx":1.5,"cy":1},"camera":"mine"})"
    "\n";

// A frame as docs/reference/pipe.md has it, written by hand: little-endian, which this computer is, too.
std::string frameBytes(std::int64_t number, double time_s, std::uint16_t step = 500,
                       std::uint32_t bytes = 2 * kPixels) {
  std::string frame = "DMCF";
  const auto append = [&frame](const auto& value) {
    frame.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  append(bytes);
  append(number);
  append(time_s);
  for (int i = 0; i < kPixels; ++i) append(step);
  return frame;
}

// A source of what a file holds.
class SavedStream {
 public:
  explicit SavedStream(const std::string& bytes) { std::ofstream(folder_ / "stream", std::ios::binary) << bytes; }
  std::unique_ptr<DepthSource> open(const SourceOptions& options = {}) const {
    return openSource("pipe:" + (folder_ / "stream").string(), options);
  }

 private:
  TemporaryFolder folder_;
};

// The first state that is no frame, and what the source says of it.
std::string endOf(const std::string& bytes) {
  const SavedStream stream(bytes);
  const auto source = stream.open();
  SensorFrame frame;
  SourceState state = SourceState::Frame;
  while (state == SourceState::Frame) state = source->next(frame, kWait);
  const std::string problem = source->problem();
  if (state == SourceState::Damaged) {
    EXPECT_EQ(source->next(frame, kWait), SourceState::Ended) << "nothing follows damage";
  }
  return state == SourceState::Ended ? "ended" : problem;
}

TEST(PipeSource, GivesFramesInMetresWithTheirNumbersAndTimes) {
  const SavedStream stream(kHeader + frameBytes(7, 100.0) + frameBytes(9, 100.1, 1000));
  const auto source = stream.open();
  EXPECT_EQ(source->info().camera.width, 4);
  EXPECT_EQ(source->info().camera_name, "mine");
  EXPECT_FALSE(source->waitsForReader());
  SensorFrame frame;
  ASSERT_EQ(source->next(frame, kWait), SourceState::Frame);
  EXPECT_EQ(frame.depth.frame, 0);
  EXPECT_EQ(frame.depth.time_s, 0);
  EXPECT_FLOAT_EQ(frame.depth.depth.at(3, 2), 1.0F);
  ASSERT_EQ(source->next(frame, kWait), SourceState::Frame);
  EXPECT_EQ(frame.depth.frame, 2) << "a frame was lost on the way";
  EXPECT_NEAR(frame.depth.time_s, 0.1, 1e-9);
  EXPECT_FLOAT_EQ(frame.depth.depth.at(0, 0), 2.0F);
  EXPECT_EQ(source->next(frame, kWait), SourceState::Ended);
}

TEST(PipeSource, TakesCorrections) {
  const SavedStream stream(kHeader + frameBytes(0, 0));
  SourceOptions options;
  options.depth_unit_m = 0.001;
  options.turn_deg = 90;
  const auto source = stream.open(options);
  EXPECT_EQ(source->info().camera.width, 3);
  SensorFrame frame;
  ASSERT_EQ(source->next(frame, kWait), SourceState::Frame);
  EXPECT_FLOAT_EQ(frame.depth.depth.at(0, 0), 0.5F);
}

TEST(PipeSource, SaysThatFramesOfAFileWait) {
  std::string header = kHeader;
  header.insert(1, R"("waits":true,)");
  const SavedStream stream(header);
  EXPECT_TRUE(stream.open()->waitsForReader());
}

TEST(PipeSource, EndsWhereWhatComesIsNoFrame) {
  const std::string whole = kHeader + frameBytes(0, 0);
  EXPECT_EQ(endOf(whole), "ended");
  EXPECT_NE(endOf(whole + "DM").find("within a frame"), std::string::npos);
  EXPECT_NE(endOf(whole + frameBytes(1, 1).substr(0, 30)).find("within a frame"), std::string::npos);
  EXPECT_NE(endOf(whole + std::string(40, 'x')).find("no frame"), std::string::npos);
  EXPECT_NE(endOf(whole + frameBytes(1, 1, 500, 0xFFFFFFFFU)).find("4294967295 bytes"), std::string::npos);
  EXPECT_NE(endOf(whole + frameBytes(-1, 1)).find("number -1"), std::string::npos);
  EXPECT_NE(endOf(whole + frameBytes(1, -1)).find("time -1"), std::string::npos);
  EXPECT_NE(endOf(whole + frameBytes(1, 1e18)).find("time"), std::string::npos);
  EXPECT_NE(endOf(whole + frameBytes(1, std::numeric_limits<double>::quiet_NaN())).find("time nan"), std::string::npos);
}

TEST(PipeSource, RefusesWhatIsNoHeader) {
  const auto refusal = [](const std::string& bytes) { return errorOf([&] { SavedStream(bytes).open(); }); };
  EXPECT_NE(refusal("").find("ended before its header"), std::string::npos);
  EXPECT_NE(refusal("\x89PNG\r\n").find("no stream of depth frames"), std::string::npos);
  EXPECT_NE(refusal("{\"a\":" + std::string(100'000, '1')).find("no stream of depth frames"), std::string::npos);
  EXPECT_NE(refusal("{}\n").find("format"), std::string::npos);
  std::string huge = kHeader;
  huge.replace(huge.find("\"width\":4"), 9, "\"width\":16384");
  huge.replace(huge.find("\"height\":3"), 10, "\"height\":16384");
  EXPECT_NE(refusal(huge).find("pixels"), std::string::npos);
  EXPECT_NE(errorOf([] { openSource("pipe:/no/such/pipe", {}); }).find("/no/such/pipe"), std::string::npos);
  EXPECT_NE(errorOf([] { openSource("pipe:/tmp", {}); }).find("is a folder"), std::string::npos);
}

// Opened before anybody writes; bytes come in pieces that fit to nothing.
TEST(PipeSource, PutsShortReadsOfAFifoTogether) {
  const TemporaryFolder folder;
  const std::string fifo = (folder / "fifo").string();
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  const std::string sent = kHeader + frameBytes(0, 0) + frameBytes(1, 0.1);
  std::thread writer([&] {
    std::this_thread::sleep_for(kMoment);
    const int file = open(fifo.c_str(), O_WRONLY | O_CLOEXEC);
    for (std::size_t at = 0; at < sent.size(); at += 7) {
      const std::size_t size = std::min<std::size_t>(7, sent.size() - at);
      EXPECT_EQ(write(file, sent.data() + at, size), static_cast<ssize_t>(size));
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(2 * kMoment);
    close(file);
  });
  const auto source = openSource("pipe:" + fifo, {});
  SensorFrame frame;
  ASSERT_EQ(source->next(frame, kWait), SourceState::Frame);
  ASSERT_EQ(source->next(frame, kWait), SourceState::Frame);
  EXPECT_EQ(frame.depth.frame, 1);
  EXPECT_EQ(source->next(frame, std::chrono::milliseconds(1)), SourceState::Waiting);
  writer.join();
  EXPECT_EQ(source->next(frame, kWait), SourceState::Ended);
}

TEST(PipeSource, ConnectsToASocket) {
  const TemporaryFolder folder;
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = (folder / "socket").string();
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  const int listener = socket(AF_UNIX, SOCK_STREAM, 0);
  ASSERT_EQ(bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(listener, 1), 0);
  std::thread sender([&] {
    const int peer = accept(listener, nullptr, nullptr);
    const std::string sent = kHeader + frameBytes(0, 0);
    EXPECT_EQ(write(peer, sent.data(), sent.size()), static_cast<ssize_t>(sent.size()));
    close(peer);
  });
  const auto source = openSource("pipe:" + path, {});
  SensorFrame frame;
  EXPECT_EQ(source->next(frame, kWait), SourceState::Frame);
  sender.join();
  close(listener);
  EXPECT_NE(errorOf([&] { openSource("pipe:" + path, {}); }).find("cannot be connected to"), std::string::npos);
}

}  // namespace
}  // namespace depthmocap

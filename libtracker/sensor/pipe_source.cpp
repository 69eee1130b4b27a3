#include <array>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/json_file.h"
#include "libtracker/recording/recording_header.h"
#include "libtracker/recording/undistort.h"
#include "libtracker/sensor/byte_pipe.h"
#include "libtracker/sensor/camera_calibration.h"
#include "libtracker/sensor/camera_driver.h"
#include "libtracker/sensor/frame_stamps.h"

// Frames that another program sends: docs/reference/pipe.md has the format.
namespace depthmocap {
namespace {

constexpr std::size_t kMostHeaderBytes = 65536;      // a recording.json has 500
constexpr std::chrono::seconds kHeaderPatience{30};  // a camera's own program may take some seconds to start it
constexpr std::string_view kFrameMark = "DMCF";
constexpr double kLatest_s = 4e9;                    // [s] the year 2096, counted from 1970; sums of it fit the clock
constexpr std::int64_t kLargestNumber = 1LL << 53U;  // of a frame: what JavaScript and double count to

// What stands before each picture, little-endian.
struct FrameHead {
  std::uint32_t bytes = 0;
  std::int64_t number = 0;
  double time_s = 0;
};
constexpr std::size_t kHeadBytes = 24;
static_assert(std::endian::native == std::endian::little);

FrameHead parseHead(std::span<const std::uint8_t, kHeadBytes> bytes) {
  FrameHead head;
  std::memcpy(&head.bytes, &bytes[4], sizeof head.bytes);
  std::memcpy(&head.number, &bytes[8], sizeof head.number);
  std::memcpy(&head.time_s, &bytes[16], sizeof head.time_s);
  return head;
}

// The first line.
std::string readHeaderLine(BytePipe& pipe, const std::string& where) {
  const auto deadline = SensorClock::now() + kHeaderPatience;
  std::string line;
  for (std::uint8_t byte = 0; line.size() < kMostHeaderBytes; line += static_cast<char>(byte)) {
    const BytePipe::Take took = pipe.take({&byte, 1}, deadline);
    if (took == BytePipe::Take::Waiting)
      throw Error(fmt::format("nothing came within {} s", kHeaderPatience.count()), where,
                  "is the camera's program running?");
    if (took == BytePipe::Take::Failed) throw Error("cannot be read: " + pipe.problem(), where);
    if (took == BytePipe::Take::Ended)
      throw Error("ended before its header", where, "did the camera's program say what is wrong?");
    if (byte == '\n') return line;
    if (line.empty() && byte != '{') break;
  }
  throw Error("is no stream of depth frames: it must begin with a line of JSON", where, "see docs/reference/pipe.md");
}

class PipeSource : public DepthSource {
 public:
  PipeSource(const std::string& address, const SourceOptions& options) : pipe_(address) {
    const std::string where = "pipe:" + address;
    info_ = parseRecordingHeader(readHeaderLine(pipe_, where), where);
    const nlohmann::json other_keys = parseJson(info_.extra_json, where);
    const auto waits = other_keys.find("waits");
    waits_ = waits != other_keys.end() && waits->is_boolean() && waits->get<bool>();
    if (options.depth_unit_m) info_.depth_unit_m = *options.depth_unit_m;
    if (options.camera && !options.depth_unit_m) info_.depth_unit_m = options.camera->depth_unit_m;
    undistortion_ = calibrate(options.camera, info_);
    steps_ = Image<std::uint16_t>(info_.camera.width, info_.camera.height);
  }
  [[nodiscard]] const RecordingInfo& info() const override { return info_; }
  [[nodiscard]] std::string problem() const override { return problem_; }
  [[nodiscard]] bool waitsForReader() const override { return waits_; }
  SourceState next(SensorFrame& frame, std::chrono::milliseconds timeout) override;

 private:
  // Takes a piece; no value: it is whole.
  std::optional<SourceState> take(std::span<std::uint8_t> piece, SensorClock::time_point deadline);
  // "", or what is wrong with the head of a frame.
  [[nodiscard]] std::string wrongWithHead() const;
  [[nodiscard]] std::span<std::uint8_t> picture() {
    return {reinterpret_cast<std::uint8_t*>(steps_.data.data()), steps_.data.size() * sizeof(std::uint16_t)};
  }
  SourceState breakOff(const std::string& why) {
    problem_ = why;
    over_ = true;
    return SourceState::Damaged;
  }

  BytePipe pipe_;
  bool waits_ = false;
  RecordingInfo info_;
  std::vector<std::int32_t> undistortion_;  // empty: none
  std::array<std::uint8_t, kHeadBytes> head_bytes_{};
  std::optional<FrameHead> head_;  // of the picture that is coming
  Image<std::uint16_t> steps_;
  FrameStamps stamps_;
  std::string problem_;
  bool over_ = false;
};

std::optional<SourceState> PipeSource::take(std::span<std::uint8_t> piece, SensorClock::time_point deadline) {
  switch (pipe_.take(piece, deadline)) {
    case BytePipe::Take::Whole:
      return std::nullopt;
    case BytePipe::Take::Waiting:
      return SourceState::Waiting;
    case BytePipe::Take::Failed:
      return breakOff("the pipe cannot be read: " + pipe_.problem());
    case BytePipe::Take::Ended:
      break;
  }
  if (head_ || pipe_.taken() > 0) return breakOff("the pipe ended within a frame");
  over_ = true;
  return SourceState::Ended;
}

std::string PipeSource::wrongWithHead() const {
  if (std::memcmp(head_bytes_.data(), kFrameMark.data(), kFrameMark.size()) != 0) {
    return "what came is no frame: it does not begin with " + std::string(kFrameMark);
  }
  const std::size_t expected = steps_.data.size() * sizeof(std::uint16_t);
  if (head_->bytes != expected) return fmt::format("a frame of {} bytes came, not of {}", head_->bytes, expected);
  if (head_->number < 0 || head_->number > kLargestNumber)
    return fmt::format("a frame had the number {}", head_->number);
  const bool timed = head_->time_s >= 0 && head_->time_s <= kLatest_s;  // false for NaN, too
  return timed ? "" : fmt::format("a frame had the time {} s", head_->time_s);
}

SourceState PipeSource::next(SensorFrame& frame, std::chrono::milliseconds timeout) {
  if (over_) return SourceState::Ended;
  const auto deadline = SensorClock::now() + timeout;
  if (!head_) {
    if (const auto state = take(head_bytes_, deadline)) return *state;
    head_ = parseHead(head_bytes_);
    if (const std::string wrong = wrongWithHead(); !wrong.empty()) return breakOff(wrong);
  }
  if (const auto state = take(picture(), deadline)) return *state;
  stamps_.stamp({head_->number, head_->time_s, false}, info_.fps, frame);
  toMetres(steps_, info_.depth_unit_m, undistortion_, frame.depth.depth);
  head_.reset();
  return SourceState::Frame;
}

std::string checkAddress(std::optional<std::string_view> address) {
  return address.value_or("").empty() ? "pipe needs - (standard input) or a path: pipe:-" : "";
}

}  // namespace

CameraDriver pipeDriver();
CameraDriver pipeDriver() {
  return {.prefix = "pipe",
          .title = "pipes",
          .names = {"pipe:-", "pipe:PATH"},
          .remark = "frames that another program sends: standard input, FIFO or Unix socket",
          .options = {},
          .check = checkAddress,
          .open = [](const std::string& address, const SourceOptions& options) -> std::unique_ptr<DepthSource> {
            return std::make_unique<PipeSource>(address, options);
          },
          .list = nullptr};
}

}  // namespace depthmocap

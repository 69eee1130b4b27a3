#include <CLI/CLI.hpp>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <thread>

#include <fmt/format.h>

#include "apps/commands.h"
#include "apps/terminal/status_line.h"
#include "apps/terminal/stop_request.h"
#include "apps/track/camera_watch.h"
#include "apps/track/source_options.h"
#include "depthmocap/error.h"
#include "libtracker/sensor/capture.h"
#include "libtracker/sensor/recorder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::milliseconds kLook{50};  // between two looks at how it goes

struct RecordOptions {
  SourceChoice source;
  fs::path out;
  std::int64_t frames = 0;  // 0 = no limit
};

std::string statusText(const CaptureStatus& camera, const RecorderStatus& recording) {
  return fmt::format("{}  recorded {}  not recorded {}  missing {}", camera.connected ? "recording" : "no camera",
                     recording.written, recording.dropped, camera.missing);
}

// Until the source ends, a limit is reached, writing fails or Ctrl-C.
CaptureStatus recordAll(DepthSource& source, Recorder& recorder, const RecordOptions& options) {
  std::atomic<bool> ended{false};
  std::int64_t taken = 0;
  Capture capture(
      source,
      [&](SensorFrame& frame) {
        taken += recorder.push(frame) ? 1 : 0;
        return options.frames == 0 || taken < options.frames;
      },
      [&ended] { ended = true; }, options.source.seconds);
  const SensorClock::time_point start = SensorClock::now();
  // A camera that sends nothing ends a limited recording, too, a second later.
  const auto overdue = [&] {
    return options.source.seconds > 0 && !source.waitsForReader() &&
           SensorClock::now() - start > std::chrono::duration<double>(options.source.seconds + 1);
  };
  StatusLine line;
  CameraWatch watch;
  while (!ended && !StopRequest::made() && !overdue() && recorder.status().failure.empty()) {
    watch.report(capture.status(), line);
    watch.report(recorder.status(), line);
    if (line.due()) line.show(statusText(capture.status(), recorder.status()));
    std::this_thread::sleep_for(kLook);
  }
  capture.stop();
  watch.report(capture.status(), line);
  return capture.status();
}

void record(const RecordOptions& options) {
  const std::unique_ptr<DepthSource> source = openChosenSource(options.source);
  Recorder recorder(options.out, source->info(), source->waitsForReader());
  const StopRequest on_ctrl_c;
  const CaptureStatus camera = recordAll(*source, recorder, options);
  recorder.finish(camera.missing);
  const RecorderStatus recording = recorder.status();
  if (recording.written == 0) throw Error("not one frame came", options.source.source);
  std::cerr << fmt::format("recorded {} frames to {}; {} were too many for the disk, {} did not arrive\n",
                           recording.written, options.out.string(), recording.dropped, camera.missing);
}

}  // namespace

void addRecordCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("record", "Records a camera, until Ctrl-C.");
  const auto options = std::make_shared<RecordOptions>();
  addSourceOptions(*command, options->source);
  command->add_option("--out", options->out, "Folder to write")->type_name("REC")->required();
  command->add_option("--frames", options->frames, "Stop after so many frames")->check(CLI::PositiveNumber);
  command->footer(
      "Frames that the disk is too slow for are counted, and their numbers are missing in frames.csv.\n"
      "Example:\n"
      "  depthmocap record --source openni2 --out take --seconds 60\n"
      "  depthmocap record --source replay:old.oni --speed 0 --out converted");
  command->callback([options] { record(*options); });
}

}  // namespace depthmocap

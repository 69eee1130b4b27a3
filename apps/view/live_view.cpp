#include "apps/view/live_view.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <fmt/format.h>

#include "apps/view/frame_sender.h"
#include "apps/view/live_page.h"
#include "apps/view/recording_desk.h"
#include "apps/view/view_options.h"
#include "calibration/live_calibration.h"
#include "depthmocap/error.h"
#include "libtracker/output/vmc_listener.h"
#include "libtracker/sensor/recorder.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

// Of the page, in one run: who watches all day makes some tens; a page that toggles without end does not fill the disk.
constexpr int kMostTakes = 100;
constexpr std::uintmax_t kLeastSpace = std::uintmax_t{2} << 30U;  // [bytes] half an hour of the largest pictures
constexpr int kLockReach = 6;                                     // [px] around the click for a measurement

// "name-001" and so on: the first that is free.
fs::path freeName(const fs::path& folder, const std::string& name, const std::string& extension) {
  for (int i = 1;; ++i) {
    fs::path path = folder / fmt::format("{}-{:03}{}", name, i, extension);
    if (!fs::exists(path)) return path;
  }
}

// The point that was clicked, camera frame [m]; nothing where the sensor saw nothing.
std::optional<Eigen::Vector3d> pointAt(const ViewCommand& click, const DepthImage& depth, const CameraModel& camera) {
  const int u = static_cast<int>(std::lround(click.x * (depth.width - 1)));
  const int v = static_cast<int>(std::lround(click.y * (depth.height - 1)));
  for (int reach = 0; reach <= kLockReach; ++reach) {
    for (int y = v - reach; y <= v + reach; ++y) {
      for (int x = u - reach; x <= u + reach; ++x) {
        if (!depth.contains(x, y) || !(depth.at(x, y) > 0)) continue;
        return camera.unproject(x, y, static_cast<double>(depth.at(x, y)));
      }
    }
  }
  return std::nullopt;
}

int peopleOf(const Tracker& tracker) {
  return static_cast<int>(tracker.people().size());
}

}  // namespace

struct LiveView::Impl {
  Impl(const ViewOptions& o, const std::string& source, const RecordingInfo& recording_info, const Models& m,
       int thread_count, Tracker& t, RecordingTracker& recordings)
      : options(o),
        info(recording_info),
        models(m),
        threads(thread_count),
        tracker(t),
        page(webServerConfig(o), pageFolder(), {"live", source, {"record", "calibrate", "reset", "lock"}, peopleOf(t)}),
        desk(page, RecordingShelf(o.folder), recordings, peopleOf(t)),
        sender(info.camera, [this](std::string message) { page.sendFrame(PageHolder::Command, std::move(message)); }) {
    if (o.vmc_listen > 0) assistants.emplace(o.vmc_listen);
  }

  void obey(const ViewCommand& command, const DepthFrame& frame);
  void record(bool on);
  void startCalibration();
  void calibrate(const DepthFrame& frame);
  void tellOfCamera(const CaptureStatus& now);

  const ViewOptions options;
  const RecordingInfo info;
  const Models models;
  const int threads;
  Tracker& tracker;
  ViewFigures figures;
  int takes = 0;
  bool camera_there = true;
  std::unique_ptr<Recorder> recorder;
  std::unique_ptr<LiveCalibration> calibration;
  LivePage page;
  RecordingDesk desk;  // after the page, as is
  FrameSender sender;
  std::optional<VmcListener> assistants;
};

void LiveView::Impl::obey(const ViewCommand& command, const DepthFrame& frame) {
  try {
    if (command.action == ViewAction::Record) record(command.on);
    if (command.action == ViewAction::Calibrate) startCalibration();
    if (command.action == ViewAction::Reset) {
      tracker.reset();
      page.sendEvent("reset", "Looking for somebody anew.");
    }
    if (command.action == ViewAction::Lock) {
      const auto point = pointAt(command, frame.depth, info.camera);
      if (!point) throw Error("there is no measurement at that place", "lock", "click on the person's body");
      tracker.lockOn(*point);
      page.sendEvent("lock", fmt::format("Looking for a person {:.1f} m away.", point->z()));
    }
  } catch (const Error& error) {
    page.sendEvent("failure", error.what());
  }
}

void LiveView::Impl::record(bool on) {
  if (on == (recorder != nullptr)) return;
  if (on) {
    if (++takes > kMostTakes) {
      throw Error(fmt::format("the page has made {} recordings", kMostTakes), "record", "start live again for more");
    }
    std::error_code unknown;
    const fs::space_info space = fs::space(options.folder, unknown);
    if (!unknown && space.available < kLeastSpace) throw Error("the disk is nearly full", "record", "free some space");
    const fs::path folder = freeName(options.folder, "take", "");
    recorder = std::make_unique<Recorder>(folder, info, false);
    page.sendEvent("record", "Recording to " + folder.string());
    return;
  }
  const std::unique_ptr<Recorder> ended = std::move(recorder);
  ended->finish(0);
  page.sendEvent("record", fmt::format("Recorded {} frames to {}", ended->status().written, ended->folder().string()));
}

void LiveView::Impl::startCalibration() {
  if (calibration) return;
  CalibrationRunConfig config;
  config.calibrator.threads = threads;
  config.camera_name = info.camera_name;
  calibration = std::make_unique<LiveCalibration>(models, info.camera, config);
  page.sendEvent("calibrate", calibration->text());
}

// Tells what to change while frames are collected; at the end the tracker takes the new body.
void LiveView::Impl::calibrate(const DepthFrame& frame) {
  if (!calibration) return;
  try {
    if (calibration->add(frame)) page.sendEvent("calibrate", calibration->text());
    const std::optional<Actor> actor = calibration->finished();
    if (!actor) return;
    const fs::path path = freeName(options.folder, "actor", ".json");
    writeActorFile(path, *actor);
    tracker.use(asSeen(*actor));
    page.sendEvent("calibrated", fmt::format("Calibrated: {:.2f} m, written to {}", actor->stature_m(), path.string()));
  } catch (const Error& error) {
    page.sendEvent("failure", error.what());
  }
  calibration.reset();
}

void LiveView::Impl::tellOfCamera(const CaptureStatus& now) {
  if (now.connected == camera_there) return;
  camera_there = now.connected;
  if (camera_there) page.sendEvent("camera_back", "The camera is back.");
  if (!camera_there) page.sendEvent("camera_lost", "The camera is away: " + now.problem + ". Plug it in again.");
}

LiveView::LiveView(const ViewOptions& options, const std::string& source, const RecordingInfo& info,
                   const Models& models, int threads, Tracker& tracker, RecordingTracker& recordings)
    : impl_(std::make_unique<Impl>(options, source, info, models, threads, tracker, recordings)) {
  impl_->page.start();
  std::cerr << "view: " << impl_->page.server().url() << std::endl;
}

LiveView::~LiveView() = default;

void LiveView::onFrame(const SessionFrame& given) {
  Impl& s = *impl_;
  const DepthFrame& frame = given.depth;
  if (s.recorder) s.recorder->push({frame, {}});
  if (s.page.frameWanted(PageHolder::Command)) {
    s.figures.clients = s.page.server().clients();
    s.figures.recording = s.recorder != nullptr;
    s.sender.send(frame.depth, given.people, s.figures);
  }
  s.calibrate(frame);
  if (s.assistants && s.assistants->calibrationAsked()) s.obey({.action = ViewAction::Calibrate}, frame);
  while (const auto command = s.page.nextCommand(PageHolder::Command)) s.obey(*command, frame);
}

void LiveView::onStatus(const SessionStatus& status) {
  impl_->tellOfCamera(status.camera);
  impl_->figures.fps = status.fps;
  impl_->figures.latency_ms = status.latency_ms;
}

}  // namespace depthmocap

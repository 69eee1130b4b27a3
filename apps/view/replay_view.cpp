#include "apps/view/replay_view.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "apps/view/label_runs.h"
#include "apps/view/live_page.h"
#include "apps/view/view_frame.h"
#include "apps/view/view_options.h"
#include "depthmocap/error.h"
#include "libtracker/core/background.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{4};
constexpr double kRepeat_s = 0.5;  // a picture that stands still is sent again, for pages that just came

struct Entry {
  std::size_t index = 0;  // in the reader
  TrackedFrame tracked;   // without labels
  LabelRuns labels;
  double fps = 0;
};

}  // namespace

struct ReplayView::Impl {
  Impl(const ViewOptions& options, const std::filesystem::path& recording, const RecordingCorrection& correction,
       std::size_t total_frames)
      : reader(openRecording(recording, correction)),
        encoder(reader->info().camera),
        total(total_frames),
        page(webServerConfig(options), pageFolder(),
             {"replay", recording.filename().string(), {"play", "pause", "seek", "speed"}}) {}

  void play();
  void obey(const ViewCommand& command);
  bool advance(double dt_s);
  bool show();
  Entry entryAt(std::size_t i);
  std::size_t tracked();

  std::unique_ptr<RecordingReader> reader;
  ViewFrameEncoder encoder;
  const std::size_t total;
  std::mutex mutex;
  std::vector<Entry> entries;  // guarded by the mutex
  std::atomic<bool> done{false};
  std::atomic<bool> stop{false};

  // Of the player's thread.
  std::size_t position = 0;  // index in entries
  double time_s = 0;         // of the recording, where the player is
  bool placed = false;       // time_s is set
  bool playing = true;
  bool changed = true;
  double speed = 1;
  DepthFrame depth;
  PartImage labels;
  ViewPicture picture;

  LivePage page;
  std::thread player;
};

std::size_t ReplayView::Impl::tracked() {
  const std::lock_guard lock(mutex);
  return entries.size();
}

Entry ReplayView::Impl::entryAt(std::size_t i) {
  const std::lock_guard lock(mutex);
  return entries[i];
}

void ReplayView::Impl::obey(const ViewCommand& command) {
  changed = true;
  const std::size_t count = tracked();
  switch (command.action) {
    case ViewAction::Play:
      playing = true;
      if (done && position + 1 >= count) {
        position = 0;
        placed = false;
      }
      break;
    case ViewAction::Pause:
      playing = false;
      break;
    case ViewAction::Seek:
      if (count > 0) position = std::min(static_cast<std::size_t>(command.frame), count - 1);
      placed = false;
      break;
    case ViewAction::Speed:
      speed = command.speed;
      break;
    default:
      break;
  }
}

// Moves on by a time of the clock; whether another frame is to be shown.
bool ReplayView::Impl::advance(double dt_s) {
  const std::lock_guard lock(mutex);
  if (entries.empty()) return false;
  if (!placed) time_s = entries[position].tracked.time_s;
  placed = true;
  if (!playing) return false;
  time_s += speed * dt_s;
  const std::size_t before = position;
  while (position + 1 < entries.size() && entries[position + 1].tracked.time_s <= time_s) ++position;
  if (position + 1 >= entries.size()) {
    time_s = std::min(time_s, entries[position].tracked.time_s + 1.0 / reader->info().fps);
    if (done) {
      playing = false;
      return true;
    }
  }
  return position != before;
}

// Sends the frame at the position, if somebody is ready for it.
bool ReplayView::Impl::show() {
  const std::size_t count = tracked();
  if (count == 0 || !page.frameWanted()) return false;
  const Entry entry = entryAt(position);
  try {
    reader->read(entry.index, depth);
  } catch (const Error&) {
    // As the tracker had it: a frame without measurement.
    depth.depth.reset(reader->info().camera.width, reader->info().camera.height, 0.0F);
  }
  entry.labels.unpack(labels);
  ViewFigures figures;
  figures.fps = entry.fps;
  figures.clients = page.server().clients();
  figures.playback = Playback{static_cast<std::int64_t>(position), static_cast<std::int64_t>(count),
                              static_cast<std::int64_t>(total), playing, speed};
  encoder.pick(depth.depth, labels, picture);
  page.sendFrame(encoder.encode(picture, entry.tracked, figures));
  return true;
}

void ReplayView::Impl::play() {
  runInBackground();
  Clock::time_point last = Clock::now();
  Clock::time_point shown = last;
  while (!stop) {
    std::this_thread::sleep_for(kTick);
    while (const auto command = page.nextCommand()) obey(*command);
    const Clock::time_point now = Clock::now();
    changed = advance(std::chrono::duration<double>(now - last).count()) || changed;
    last = now;
    const bool repeat = std::chrono::duration<double>(now - shown).count() > kRepeat_s;
    if ((changed || repeat) && show()) {
      changed = false;
      shown = now;
    }
  }
}

ReplayView::ReplayView(const ViewOptions& options, const std::filesystem::path& recording,
                       const RecordingCorrection& correction, std::size_t total)
    : impl_(std::make_unique<Impl>(options, recording, correction, total)) {
  impl_->page.start();
  impl_->player = std::thread([this] { impl_->play(); });
  std::cerr << "view: " << impl_->page.server().url() << std::endl;
}

ReplayView::~ReplayView() {
  impl_->stop = true;
  impl_->player.join();
}

void ReplayView::onFrame(const SessionFrame& frame) {
  Entry entry;
  entry.index = frame.index;
  entry.labels = LabelRuns(frame.tracked.labels, impl_->encoder.step());
  entry.tracked = frame.tracked;
  entry.tracked.labels = {};
  entry.fps = frame.fps;
  const std::lock_guard lock(impl_->mutex);
  impl_->entries.push_back(std::move(entry));
}

void ReplayView::tracked() {
  impl_->done = true;
}

}  // namespace depthmocap

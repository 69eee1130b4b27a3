#include "apps/view/recording_player.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "apps/view/label_runs.h"
#include "apps/view/view_frame.h"
#include "depthmocap/error.h"
#include "libtracker/core/background.h"
#include "libtracker/session/people_labels.h"

namespace depthmocap {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTick{4};
constexpr double kRepeat_s = 0.5;  // a picture that stands still is sent again, for pages that just came

struct Entry {
  std::size_t index = 0;             // in the reader
  std::vector<TrackedFrame> people;  // without labels
  LabelRuns labels;                  // of all
  double fps = 0;
};

}  // namespace

struct RecordingPlayer::Impl {
  Impl(LivePage& p, PageHolder h, std::unique_ptr<RecordingReader> r, std::size_t total_frames)
      : page(p), holder(h), reader(std::move(r)), encoder(reader->info().camera), total(total_frames) {}

  void play();
  void obey(const ViewCommand& command);
  bool advance(double dt_s);
  bool show();
  Entry entryAt(std::size_t i);
  std::size_t tracked();

  LivePage& page;
  const PageHolder holder;
  std::unique_ptr<RecordingReader> reader;
  ViewFrameEncoder encoder;
  std::atomic<std::size_t> total;
  PartImage all_labels;  // of the tracker's thread
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

  std::thread player;
};

std::size_t RecordingPlayer::Impl::tracked() {
  const std::lock_guard lock(mutex);
  return entries.size();
}

Entry RecordingPlayer::Impl::entryAt(std::size_t i) {
  const std::lock_guard lock(mutex);
  return entries[i];
}

void RecordingPlayer::Impl::obey(const ViewCommand& command) {
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
bool RecordingPlayer::Impl::advance(double dt_s) {
  const std::lock_guard lock(mutex);
  if (entries.empty()) return false;
  if (!placed) time_s = entries[position].people.front().time_s;
  placed = true;
  if (!playing) return false;
  time_s += speed * dt_s;
  const std::size_t before = position;
  while (position + 1 < entries.size() && entries[position + 1].people.front().time_s <= time_s) ++position;
  if (position + 1 >= entries.size()) {
    time_s = std::min(time_s, entries[position].people.front().time_s + 1.0 / reader->info().fps);
    if (done) {
      playing = false;
      return true;
    }
  }
  return position != before;
}

// Sends the frame at the position, if somebody is ready for it.
bool RecordingPlayer::Impl::show() {
  const std::size_t count = tracked();
  if (count == 0 || !page.frameWanted(holder)) return false;
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
                              static_cast<std::int64_t>(total.load()), playing, speed};
  encoder.pick(depth.depth, labels, picture);
  page.sendFrame(holder, encoder.encode(picture, entry.people, figures));
  return true;
}

void RecordingPlayer::Impl::play() {
  runInBackground();
  Clock::time_point last = Clock::now();
  Clock::time_point shown = last;
  while (!stop) {
    std::this_thread::sleep_for(kTick);
    while (const auto command = page.nextCommand(holder)) obey(*command);
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

const std::vector<std::string> RecordingPlayer::kControls = {"play", "pause", "seek", "speed"};

RecordingPlayer::RecordingPlayer(LivePage& page, PageHolder holder, std::unique_ptr<RecordingReader> reader,
                                 std::size_t total)
    : impl_(std::make_unique<Impl>(page, holder, std::move(reader), total)) {
  impl_->player = std::thread([this] { impl_->play(); });
}

RecordingPlayer::~RecordingPlayer() {
  impl_->stop = true;
  impl_->player.join();
}

void RecordingPlayer::onFrame(const SessionFrame& frame) {
  Entry entry;
  entry.index = frame.index;
  entry.labels = LabelRuns(labelsOfAll(frame.people, kPersonLabelStep, impl_->all_labels), impl_->encoder.step());
  for (const TrackedFrame* person : frame.people) {
    entry.people.push_back(*person);
    entry.people.back().labels = {};
  }
  entry.fps = frame.fps;
  const std::lock_guard lock(impl_->mutex);
  impl_->entries.push_back(std::move(entry));
}

void RecordingPlayer::tracked() {
  impl_->total = impl_->tracked();
  impl_->done = true;
}

}  // namespace depthmocap

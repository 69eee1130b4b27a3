#include "apps/view/recording_desk.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "apps/view/export_folder.h"
#include "apps/view/recording_player.h"
#include "apps/view/request_guard.h"
#include "depthmocap/error.h"
#include "libtracker/core/background.h"

namespace depthmocap {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTellEvery{200};  // how far the tracking is

// What became of the recording that was opened last.
struct Job {
  std::string state = "none";  // "tracking", "done" or "failed"
  std::string recording;       // its id
  std::string name;            // of it, for people
  std::string problem;         // why it failed
  std::size_t done = 0;        // frames of all passes
  std::size_t total = 0;
  std::vector<ExportFile> files;
};

json fileIn(const ExportFile& file) {
  return {{"format", file.format}, {"name", file.name}, {"bytes", file.bytes}};
}

json jobIn(const Job& job) {
  json files = json::array();
  for (const ExportFile& file : job.files) files.push_back(fileIn(file));
  return {{"type", "job"},    {"state", job.state}, {"recording", job.recording}, {"name", job.name},
          {"done", job.done}, {"total", job.total}, {"problem", job.problem},     {"files", files}};
}

json recordingIn(const ShelvedRecording& shelved) {
  return {{"id", shelved.id},         {"name", shelved.name},     {"problem", shelved.problem},
          {"frames", shelved.frames}, {"bytes", shelved.bytes},   {"duration_s", shelved.duration_s},
          {"width", shelved.width},   {"height", shelved.height}, {"modified_s", shelved.modified_s}};
}

std::string dumped(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace

struct RecordingDesk::Impl {
  Impl(LivePage& p, RecordingShelf s, RecordingTracker& t, int n)
      : page(p), shelf(std::move(s)), tracker(t), people(n) {}

  void ask(const ViewCommand& command);
  void work();
  void begin(const ViewCommand& command);
  void track(const ShelvedRecording& recording, int people_count);
  void end();
  void tell(const std::function<void(Job&)>& change);
  [[nodiscard]] ShelvedRecording chosen(const std::string& id);
  [[nodiscard]] WebContent list();
  [[nodiscard]] WebContent send(const std::string& target);

  LivePage& page;
  RecordingShelf shelf;
  RecordingTracker& tracker;
  const int people;
  std::mutex mutex;
  std::condition_variable changed;
  std::optional<ViewCommand> asked;  // guarded by the mutex, as are
  Job job;
  std::shared_ptr<ExportFolder> folder;  // of the job's files
  bool stop = false;
  std::atomic<bool> cancelled{false};     // what is being tracked
  std::optional<RecordingPlayer> player;  // of the desk's thread
  std::thread thread;
};

// On the server's thread.
void RecordingDesk::Impl::ask(const ViewCommand& command) {
  {
    const std::lock_guard lock(mutex);
    const bool busy = job.state == "tracking" || (asked && asked->action == ViewAction::Open);
    if (command.action == ViewAction::Open && busy) {
      throw Error("a recording is being tracked", "open", "wait until it is done, or stop it");
    }
    if (command.action == ViewAction::Close) cancelled = true;
    asked = command;
  }
  changed.notify_one();
}

void RecordingDesk::Impl::work() {
  runInBackground();
  for (;;) {
    ViewCommand command;
    {
      std::unique_lock lock(mutex);
      changed.wait(lock, [this] { return asked || stop; });
      if (stop) return;
      command = *std::exchange(asked, std::nullopt);
      if (command.action == ViewAction::Open) cancelled = false;
    }
    end();
    if (command.action == ViewAction::Open) begin(command);
  }
}

void RecordingDesk::Impl::tell(const std::function<void(Job&)>& change) {
  std::string message;
  {
    const std::lock_guard lock(mutex);
    change(job);
    message = dumped(jobIn(job));
  }
  page.server().sendText(message);
}

ShelvedRecording RecordingDesk::Impl::chosen(const std::string& id) {
  std::optional<ShelvedRecording> recording = shelf.find(id);
  if (!recording) throw Error("there is no such recording any more", "the page", "load the list again");
  if (!recording->problem.empty()) throw Error("cannot be opened: " + recording->problem, recording->name);
  if (recording->frames > kMostFrames) {
    throw Error(fmt::format("has {} frames, of which the page takes at most {}", recording->frames, kMostFrames),
                recording->name, "depthmocap replay tracks recordings of any length");
  }
  return *recording;
}

void RecordingDesk::Impl::begin(const ViewCommand& command) {
  tell([&](Job& j) {
    j.state = "tracking";
    j.recording = j.name = command.recording;
  });
  try {
    track(chosen(command.recording), command.people);
  } catch (const std::exception& error) {
    tell([&](Job& j) {
      j.state = "failed";
      j.problem = error.what();
    });
  }
}

void RecordingDesk::Impl::track(const ShelvedRecording& recording, int people_count) {
  const auto files = std::make_shared<ExportFolder>(recording.name);
  const int count = people_count > 0 ? people_count : people;
  player.emplace(page, PageHolder::Opened, openRecording(recording.recording.path, recording.recording.correction),
                 recording.frames);
  page.open({"replay", recording.name, RecordingPlayer::kControls, count});
  tell([&](Job& j) {
    j.name = recording.name;
    j.total = recording.frames;
  });
  Clock::time_point told = Clock::now();
  const auto progress = [&](std::size_t done, std::size_t total) {
    if (Clock::now() - told < kTellEvery) return;
    told = Clock::now();
    tell([&](Job& j) {
      j.done = done;
      j.total = total;
    });
  };
  tracker.track({recording.recording, count, files->path(), files->name()}, *player,
                {progress, {}, [this] { return cancelled.load(); }});
  player->tracked();
  if (cancelled) return;  // "close" follows
  tell([&](Job& j) {
    folder = files;
    j.state = "done";
    j.done = j.total;
    j.files = files->list(tracker.formats());
  });
}

// Gives the page back.
void RecordingDesk::Impl::end() {
  if (player) page.close();
  player.reset();
  tell([&](Job& j) {
    j = {};
    folder.reset();
  });
}

WebContent RecordingDesk::Impl::list() {
  json recordings = json::array();
  for (const ShelvedRecording& shelved : shelf.list()) recordings.push_back(recordingIn(shelved));
  json formats = json::array();
  for (const ExportFormat& format : tracker.formats()) {
    formats.push_back({{"name", format.name}, {"title", format.title}});
  }
  const std::lock_guard lock(mutex);
  return {"application/json", dumped({{"recordings", recordings}, {"formats", formats}, {"job", jobIn(job)}})};
}

// The name is compared with those that are there; no path is made of it.
WebContent RecordingDesk::Impl::send(const std::string& target) {
  const std::string_view name = queryValue(target, "file");
  const std::lock_guard lock(mutex);
  const auto file = std::ranges::find(job.files, name, &ExportFile::name);
  if (file == job.files.end()) {
    throw Error("there is no such file; open the recording first, and name a file of its list", "export");
  }
  WebContent content{"application/octet-stream", ""};
  content.file = folder->path() / file->name;
  return content;
}

RecordingDesk::RecordingDesk(LivePage& page, RecordingShelf shelf, RecordingTracker& tracker, int people)
    : impl_(std::make_unique<Impl>(page, std::move(shelf), tracker, people)) {
  Impl& desk = *impl_;
  page.onOpening([&desk](const ViewCommand& command) { desk.ask(command); });
  page.server().onGetAside("/recordings", [&desk](const std::string&) { return desk.list(); });
  page.server().onGetAside("/export", [&desk](const std::string& target) { return desk.send(target); });
  desk.thread = std::thread([&desk] { desk.work(); });
}

RecordingDesk::~RecordingDesk() {
  impl_->page.server().stop();
  {
    const std::lock_guard lock(impl_->mutex);
    impl_->stop = true;
    impl_->cancelled = true;
  }
  impl_->changed.notify_one();
  impl_->thread.join();
}

}  // namespace depthmocap

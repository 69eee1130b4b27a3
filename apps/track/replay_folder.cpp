#include "apps/track/replay_folder.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>

#include <fmt/format.h>

#include "apps/terminal/progress.h"
#include "apps/terminal/stop_request.h"
#include "apps/track/folder_summary.h"
#include "apps/track/tracker_setup.h"
#include "depthmocap/error.h"
#include "libtracker/core/json_file.h"
#include "libtracker/core/parallel.h"
#include "libtracker/core/printable.h"
#include "libtracker/session/rate_meter.h"

namespace depthmocap {
namespace {

namespace fs = std::filesystem;

void collect(const fs::path& folder, const fs::path& top, std::vector<fs::path>& found) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (looksLikeRecording(entry.path())) {
      found.push_back(entry.path().lexically_relative(top));
    } else if (entry.is_directory() && !entry.is_symlink()) {
      collect(entry.path(), top, found);
    }
  }
}

// What the results depend on, so that a folder is not filled with results of two kinds.
nlohmann::json optionsThatMatter(const ReplayOptions& o) {
  const TrackOptions& t = o.track;
  return {{"people", t.people},
          {"actor", t.actor.string()},
          {"forest", t.forest.string()},
          {"posedb", t.posedb.string()},
          {"config", t.config.string()},
          {"method", t.method},
          {"without", t.without},
          {"stature", t.assumed_stature_m},
          {"smooth", t.smooth},
          {"look_ahead", o.session.look_ahead_s},
          {"passes", o.session.passes},
          {"first", o.session.first_frame},
          {"last", o.session.last_frame},
          {"camera", o.correction.camera_file.string()},
          {"depth_unit_mm", o.correction.depth_unit_mm.value_or(0.0)},
          {"turn", o.correction.turn_deg},
          {"bvh_unit", t.bvh_unit},
          {"rig", t.rig},
          {"origin", t.origin}};
}

// Writes the options beside the results, or checks them against those of the run before.
void agreeOnOptions(const ReplayOptions& options, const fs::path& out) {
  const fs::path file = out / "batch.json";
  const nlohmann::json wanted = {
      {"format", "depthmocap-batch"}, {"version", 1}, {"options", optionsThatMatter(options)}};
  if (!fs::exists(file)) return writeJsonFile(file, wanted);
  const nlohmann::json before = readJsonFile(file);
  checkJsonFormat(before, "depthmocap-batch", 1, file.string());
  if (before == wanted) return;
  throw Error("holds results of other options (see batch.json)", out.string(), "name another folder for --out");
}

fs::path outputOf(const fs::path& out, const fs::path& name) {
  return (out / name).replace_extension(name.extension() == ".oni" ? "" : name.extension());
}

// One recording on its way.
class FolderRun {
 public:
  FolderRun(const ReplayOptions& options, const fs::path& out)
      : options_(options), correction_(options.correction.read()), models_(loadModels(options.track)) {
    for (const fs::path& name : recordingsBelow(options.recording)) {
      const fs::path results = outputOf(out, name);
      entries_.push_back({name.string(), results, fs::exists(results / "stats.json") ? "done before" : "stopped"});
    }
  }

  [[nodiscard]] const std::vector<FolderEntry>& entries() const { return entries_; }

  void run() {
    std::vector<FolderEntry*> left;
    for (FolderEntry& entry : entries_) {
      if (entry.status != "done before") left.push_back(&entry);
    }
    if (left.empty()) return;
    Progress progress("tracking recordings", left.size() * kSteps);
    progress_ = &progress;
    parallelFor(options_.track.threads, left.size(), [&](std::size_t i) {
      if (!StopRequest::made()) attempt(*left[i]);
    });
    progress_ = nullptr;
  }

 private:
  static constexpr std::size_t kSteps = 1000;  // of the progress bar for one recording

  void attempt(FolderEntry& entry) {
    std::size_t shown = 0;
    try {
      track(entry, shown);
    } catch (const std::exception& error) {
      entry.status = "failed";
      tell(fmt::format("depthmocap: {}: {}", entry.name, error.what()));
    }
    advance(kSteps - shown);
  }

  void track(FolderEntry& entry, std::size_t& shown) {
    const auto start = std::chrono::steady_clock::now();
    ReplayOptions options = options_;
    options.recording = options_.recording / entry.name;
    options.track.threads = 1;  // one for each recording
    options.track.joints = entry.out / "joints.csv";
    options.track.pose = entry.out / "pose.csv";
    options.track.angles = entry.out / "angles.csv";
    options.track.bvh = entry.out / "motion.bvh";
    fs::create_directories(entry.out);
    RecordingRun run(options, models_, correction_);
    run.session.addSink(run.outputs);
    run.session.run({[&](std::size_t done, std::size_t total) {
                       const std::size_t now = done * kSteps / std::max<std::size_t>(total, 1);
                       advance(now - shown);
                       shown = now;
                     },
                     [&](const std::string& message) { tell("depthmocap: warning: " + entry.name + ": " + message); },
                     [] { return StopRequest::made(); }});
    if (StopRequest::made()) return;
    run.outputs.finish();
    run.session.stats().write(entry.out / "stats.json", millisecondsSince(start) / 1000.0, options.track.actor.empty());
    entry.status = "tracked";
  }

  void advance(std::size_t steps) {
    const std::lock_guard lock(terminal_);
    done_ += steps;
    progress_->update(done_);
  }

  void tell(const std::string& line) {
    constexpr std::size_t kMostBytes = 4000;  // as the program's own errors
    const std::lock_guard lock(terminal_);
    std::cerr << printable(line, kMostBytes) << '\n';
  }

  const ReplayOptions& options_;
  const RecordingCorrection correction_;
  const Models models_;
  std::vector<FolderEntry> entries_;
  std::mutex terminal_;
  std::size_t done_ = 0;
  Progress* progress_ = nullptr;
};

}  // namespace

std::vector<fs::path> recordingsBelow(const fs::path& folder) {
  std::vector<fs::path> found;
  try {
    collect(folder, folder, found);
  } catch (const fs::filesystem_error& error) {
    throw Error("cannot be searched: " + error.code().message(), folder.string());
  }
  if (found.empty()) throw Error("holds no recording", folder.string(), "name a folder of recordings");
  std::ranges::sort(found);
  return found;
}

void replayFolder(const ReplayOptions& options, const fs::path& out) {
  std::error_code failure;
  fs::create_directories(out, failure);
  if (failure) throw Error("cannot make the folder: " + failure.message(), out.string());
  FolderRun folder(options, out);
  agreeOnOptions(options, out);
  const StopRequest on_ctrl_c;
  folder.run();
  writeFolderSummary(out / "summary.csv", folder.entries());
  std::cout << folderTable(folder.entries());
  const auto failed = std::ranges::count(folder.entries(), std::string("failed"), &FolderEntry::status);
  if (failed > 0) {
    throw Error(fmt::format("{} of {} recordings failed", failed, folder.entries().size()), options.recording.string(),
                "the lines above say why; the same command goes on with them");
  }
}

}  // namespace depthmocap

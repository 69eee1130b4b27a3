#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "libtracker/recording/recording.h"
#include "libtracker/session/frame_sink.h"
#include "libtracker/session/replay_session.h"

namespace depthmocap {

// A recording with what its user knows better than it.
struct NamedRecording {
  std::filesystem::path path;
  RecordingCorrection correction;
};

// A kind of file that a tracked recording can be had as.
struct ExportFormat {
  std::string name;    // "gltf"
  std::string title;   // "glTF (.glb)", for people
  std::string ending;  // ".glb", of no other format
};

// What the page wants tracked.
struct TrackTask {
  NamedRecording recording;
  int people = 1;
  std::filesystem::path folder;  // for the files
  std::string name;              // of the files, without ending
};

// Tracks recordings for the page. The commands, which know how, implement it.
class RecordingTracker {
 public:
  virtual ~RecordingTracker() = default;
  [[nodiscard]] virtual const std::vector<ExportFormat>& formats() const = 0;
  // As `replay` tracks it: every frame goes to the watcher, too, and a file of every format to the folder, the same
  // bytes as those of `replay`. Where several people are tracked some formats have a file for each. Error as replay.
  virtual void track(const TrackTask& task, FrameSink& watcher, const ReplayHooks& hooks) = 0;
};

}  // namespace depthmocap

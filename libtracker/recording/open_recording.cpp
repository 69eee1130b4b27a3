#include "depthmocap/error.h"
#include "libtracker/recording/image_list_reader.h"
#include "libtracker/recording/oni_reader.h"
#include "libtracker/recording/recording.h"

namespace depthmocap {

namespace fs = std::filesystem;

std::unique_ptr<RecordingReader> openRecording(const fs::path& path) {
  if (!fs::exists(path)) throw Error("there is no such recording", path.string());
  if (!fs::is_directory(path)) {
    if (path.extension() == ".oni") return openOniRecording(path);
    throw Error("is a file; a recording is a folder, or an OpenNI file named .oni", path.string());
  }
  if (fs::exists(path / "recording.json")) return openRecordingFolder(path);
  if (fs::exists(path / "depth.txt")) return openTumFolder(path);
  throw Error("is no recording: it holds neither recording.json nor depth.txt", path.string());
}

}  // namespace depthmocap

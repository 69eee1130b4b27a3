#include <algorithm>
#include <vector>

#include "depthmocap/error.h"
#include "libtracker/core/csv.h"
#include "libtracker/recording/image_list_reader.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {

constexpr double kStepsPerMetre = 5000.0;

// Intrinsics that the benchmark's authors publish: depth is registered to the colour camera. Sequences of the third
// camera are named freiburg3 and were rectified by the authors; for all others they recommend the default of ROS.
CameraModel tumCamera(const fs::path& folder) {
  CameraModel camera;  // 640x480, 525, 319.5, 239.5
  if (fs::weakly_canonical(folder).string().find("freiburg3") != std::string::npos) {
    camera.fx = 535.4;
    camera.fy = 539.2;
    camera.cx = 320.1;
    camera.cy = 247.6;
  }
  return camera;
}

std::vector<IndexEntry> readIndex(const fs::path& folder) {
  const fs::path file = folder / "depth.txt";
  CsvReader rows(file, ' ');
  std::vector<IndexEntry> index;
  while (rows.next()) {
    if (rows.fieldCount() != 2) rows.fail("must be a time and a file name");
    IndexEntry entry{static_cast<std::int64_t>(index.size()), rows.number(0),
                     pathInside(folder, rows.field(1), file.string())};
    if (!index.empty() && entry.time_s <= index.back().time_s) rows.fail("times must grow from row to row");
    index.push_back(std::move(entry));
  }
  if (index.empty()) throw Error("the recording has no frame", file.string());
  return index;
}

// The median step, since frames may be missing. [1/s]
double frameRate(const std::vector<IndexEntry>& index) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < index.size(); ++i) steps.push_back(index[i].time_s - index[i - 1].time_s);
  if (steps.empty()) return RecordingInfo{}.fps;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return 1.0 / *middle;
}

}  // namespace

std::unique_ptr<RecordingReader> openTumFolder(const fs::path& folder) {
  std::vector<IndexEntry> index = readIndex(folder);
  RecordingInfo info;
  info.camera = tumCamera(folder);
  info.fps = frameRate(index);
  info.depth_unit_m = 1.0 / kStepsPerMetre;
  info.camera_name = "kinect1";
  info.note = "TUM RGB-D " + fs::weakly_canonical(folder).filename().string();
  return std::make_unique<ImageListReader>(std::move(info), std::move(index));
}

}  // namespace depthmocap

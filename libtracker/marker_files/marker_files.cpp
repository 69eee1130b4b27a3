#include "libtracker/marker_files/marker_files.h"

#include <algorithm>
#include <cctype>

#include "depthmocap/error.h"

namespace depthmocap {

MarkerFileKind markerFileKind(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".csv") return MarkerFileKind::JointsCsv;
  if (ending == ".trc") return MarkerFileKind::Trc;
  if (ending == ".c3d") return MarkerFileKind::C3d;
  throw Error("is no file of markers by its name", path.string(), "markers are in .csv (joints), .trc or .c3d files");
}

UpAxis usualUpAxis(MarkerFileKind kind) {
  switch (kind) {
    case MarkerFileKind::JointsCsv:
      return UpAxis::MinusY;
    case MarkerFileKind::Trc:
      return UpAxis::PlusY;
    case MarkerFileKind::C3d:
      break;
  }
  return UpAxis::PlusZ;
}

MarkerSequence readMarkers(const std::filesystem::path& path) {
  const MarkerFileKind kind = markerFileKind(path);
  MarkerSequence markers = kind == MarkerFileKind::JointsCsv ? readJointMarkers(path)
                           : kind == MarkerFileKind::Trc     ? readTrc(path)
                                                             : readC3d(path);
  if (markers.frames() == 0 || markers.tracks.empty()) throw Error("holds no marker", path.string());
  return markers;
}

}  // namespace depthmocap

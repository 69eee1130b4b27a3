#include <limits>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/atomic_file.h"
#include "libtracker/core/csv.h"
#include "libtracker/core/parse_number.h"
#include "libtracker/marker_files/length_unit.h"
#include "libtracker/marker_files/marker_collector.h"
#include "libtracker/marker_files/marker_files.h"

// Track row column, of Motion Analysis: lines of fields between tabs. PathFileType; names and values of DataRate,
// CameraRate, NumFrames, NumMarkers, Units, ...; Frame#, Time and the markers' names, three columns each; X1 Y1 Z1 ...;
// then a line a frame, empty fields where a marker was not seen.
namespace depthmocap {
namespace {

constexpr std::size_t kFirstMarkerColumn = 2;  // after Frame# and Time

struct TrcHeader {
  double fps = 0;
  double metres_per_unit = 0.001;
  std::vector<std::string> names;
  std::vector<std::size_t> columns;  // of each marker's x
};

TrcHeader readTrcHeader(CsvReader& csv, const std::string& where) {
  if (!csv.next() || csv.field(0) != "PathFileType") {
    throw Error("is no TRC file: its first line must begin with PathFileType", where);
  }
  if (!csv.next()) throw Error("ends within its header", where);
  std::vector<std::string> keys;
  for (std::size_t i = 0; i < csv.fieldCount(); ++i) keys.emplace_back(csv.field(i));
  if (!csv.next()) throw Error("ends within its header", where);
  TrcHeader header;
  for (std::size_t i = 0; i < std::min(keys.size(), csv.fieldCount()); ++i) {
    if (keys[i] == "DataRate") header.fps = csv.number(i);
    if (keys[i] == "Units") header.metres_per_unit = metresPerUnit(csv.field(i), where);
  }
  if (!(header.fps > 0)) throw Error("DataRate must be above 0", where);
  if (!csv.next() || csv.field(0) != "Frame#") throw Error("the line of names must begin with Frame#", where);
  for (std::size_t i = kFirstMarkerColumn; i < csv.fieldCount(); ++i) {
    if (csv.field(i).empty()) continue;
    header.names.emplace_back(csv.field(i));
    header.columns.push_back(i);
  }
  // Some programs write each name once without the two empty fields that belong to it.
  const bool is_dense = header.columns.size() > 1 && header.columns[1] == kFirstMarkerColumn + 1;
  for (std::size_t m = 0; is_dense && m < header.columns.size(); ++m) header.columns[m] = kFirstMarkerColumn + 3 * m;
  return header;
}

double coordinate(const CsvReader& csv, std::size_t i) {
  if (i >= csv.fieldCount()) return std::numeric_limits<double>::quiet_NaN();
  return parseDouble(csv.field(i)).value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

MarkerSequence readTrc(const std::filesystem::path& path) {
  CsvReader csv(path, '\t');
  const TrcHeader header = readTrcHeader(csv, path.string());
  MarkerCollector collector(path, header.names);
  while (csv.next()) {
    const std::string_view first = csv.field(0);
    if (first.empty() || first.front() == 'X' || first.front() == 'x') continue;  // the line X1 Y1 Z1 ...
    if (csv.fieldCount() < kFirstMarkerColumn) csv.fail("has no time");
    collector.startFrame(csv.integer(0), csv.number(1));
    for (std::size_t m = 0; m < header.names.size(); ++m) {
      const std::size_t x = header.columns[m];
      collector.add(m, header.metres_per_unit *
                           Eigen::Vector3d(coordinate(csv, x), coordinate(csv, x + 1), coordinate(csv, x + 2)));
    }
  }
  return collector.finish(header.fps);
}

void writeTrc(const MarkerSequence& markers, const std::filesystem::path& path) {
  AtomicFile file(path);
  const std::size_t count = markers.tracks.size();
  file.write(fmt::format("PathFileType\t4\t(X/Y/Z)\t{}\n", path.filename().string()));
  file.write("DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n");
  const std::int64_t first = markers.frame.empty() ? 1 : markers.frame.front();
  file.write(
      fmt::format("{0:.6g}\t{0:.6g}\t{1}\t{2}\tmm\t{0:.6g}\t{3}\t{1}\n", markers.fps, markers.frames(), count, first));
  std::string names = "Frame#\tTime";
  std::string axes = "\t";
  for (std::size_t m = 0; m < count; ++m) {
    names += fmt::format("\t{}\t\t", markers.tracks[m].name);
    axes += fmt::format("\tX{0}\tY{0}\tZ{0}", m + 1);
  }
  file.write(names + "\n" + axes + "\n\n");
  for (std::size_t t = 0; t < markers.frames(); ++t) {
    std::string row = fmt::format("{}\t{:.6f}", markers.frame[t], markers.time_s[t]);
    const auto column = static_cast<Eigen::Index>(t);
    for (const MarkerTrack& track : markers.tracks) {
      const Eigen::Vector3d p_mm = 1000.0 * track.p.col(column);
      row += track.seen[column] ? fmt::format("\t{:.4f}\t{:.4f}\t{:.4f}", p_mm.x(), p_mm.y(), p_mm.z()) : "\t\t\t";
    }
    file.write(row + "\n");
  }
  file.commit();
}

}  // namespace depthmocap

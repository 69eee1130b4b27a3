#include <limits>
#include <sstream>

#include "depthmocap/joints.h"
#include "libtracker/core/csv.h"
#include "libtracker/core/parse_number.h"
#include "libtracker/marker_files/marker_collector.h"
#include "libtracker/marker_files/marker_files.h"
#include "libtracker/recording/track_files.h"

namespace depthmocap {
namespace {

constexpr std::size_t kFirstJointColumn = 3;  // after frame, time_s, state
constexpr std::size_t kColumnsPerJoint = 4;   // x y z c

std::vector<std::string> columnsOf(const std::string& header) {
  std::vector<std::string> columns;
  std::istringstream words(header.substr(0, header.find('\n')));
  for (std::string column; std::getline(words, column, ',');) columns.push_back(column);
  return columns;
}

// A gap may be an empty field or a word such as nan.
double numberOrGap(std::string_view field) {
  return parseDouble(field).value_or(std::numeric_limits<double>::quiet_NaN());
}

bool isFirstPerson(const CsvReader& csv, std::size_t person_column) {
  return person_column >= csv.fieldCount() || csv.field(person_column).empty() || csv.field(person_column) == "1";
}

}  // namespace

MarkerSequence readJointMarkers(const std::filesystem::path& path) {
  CsvReader csv(path);
  csv.readHeader(columnsOf(jointsHeader()));
  std::size_t person_column = csv.fieldCount();
  for (std::size_t i = 0; i < csv.fieldCount(); ++i) {
    if (csv.field(i) == "person") person_column = i;
  }
  MarkerCollector collector(path, {kJointNames.begin(), kJointNames.end()});
  while (csv.next()) {
    if (!isFirstPerson(csv, person_column)) continue;
    collector.startFrame(csv.integer(0), csv.number(1));
    for (std::size_t joint = 0; joint < kJointCount; ++joint) {
      const std::size_t x = kFirstJointColumn + kColumnsPerJoint * joint;
      if (parseDouble(csv.field(x + 3)).value_or(0.0) <= 0) continue;
      collector.add(joint, {numberOrGap(csv.field(x)), numberOrGap(csv.field(x + 1)), numberOrGap(csv.field(x + 2))});
    }
  }
  return collector.finish(0);
}

}  // namespace depthmocap

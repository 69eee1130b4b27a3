#pragma once
#include <optional>
#include <string>
#include <vector>

#include "libtracker/core/csv.h"
#include "libtracker/recording/track_files.h"

// What the files of one row a frame and person have in common: joints, poses, angles.
namespace depthmocap {

TrackState parseState(const CsvReader& csv, std::string_view text);

// Frame and time of the current row, which all kinds of file start with.
template <typename Row>
Row startRow(const CsvReader& csv, const std::vector<Row>& rows) {
  Row row;
  row.frame = csv.integer(0);
  row.time_s = csv.number(1);
  if (!rows.empty() && row.frame <= rows.back().frame) csv.fail("frame numbers must grow from row to row");
  if (!rows.empty() && row.time_s <= rows.back().time_s) csv.fail("times must grow from row to row");
  return row;
}

// The end of a header, and of a row: the column that says whose the row is, where the file is of several people.
std::string personHeader(FileOf kind);
std::string personField(FileOf kind, TrackState state, int person);

// Finds the rows of one person.
class WhoseRow {
 public:
  // Right after the header was read.
  WhoseRow(const CsvReader& csv, int person);
  // Whether the current row is the wanted person's.
  [[nodiscard]] bool wanted(const CsvReader& csv) const;

 private:
  int person_;
  std::optional<std::size_t> column_;
};

}  // namespace depthmocap

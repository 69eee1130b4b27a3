#include "libtracker/recording/tum_index.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "depthmocap/error.h"
#include "libtracker/core/csv.h"
#include "libtracker/recording/png_file.h"

namespace depthmocap {

namespace fs = std::filesystem;

namespace {

constexpr double kNumberedFps = 30.0;  // [1/s] of recordings whose rows have numbers, no times

bool isDepthPicture(const fs::path& file) {
  try {
    png16Size(file);
    return true;
  } catch (const Error&) {
    return false;
  }
}

// Where the time of the depth picture stands in a row of `time file` or `time file time file`.
std::size_t timeColumn(const CsvReader& row, const fs::path& folder, const std::string& where) {
  if (row.fieldCount() == 2) return 0;
  if (row.fieldCount() != 4) row.fail("must be a time and a file name, or two of each");
  for (const std::size_t column : {0U, 2U}) {
    if (isDepthPicture(pathInside(folder, row.field(column + 1), where))) return column;
  }
  row.fail("neither file is a 16-bit one-channel grey PNG");
}

std::vector<double> stepsOf(const std::vector<IndexEntry>& entries) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < entries.size(); ++i) steps.push_back(entries[i].time_s - entries[i - 1].time_s);
  return steps;
}

// The median step, since frames may be missing. [1/s]
double frameRate(std::vector<double> steps) {
  if (steps.empty()) return RecordingInfo{}.fps;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return 1.0 / *middle;
}

bool areNumbers(const std::vector<IndexEntry>& entries) {
  const double first = entries.front().time_s;
  return entries.size() > 1 && (first == 0 || first == 1) &&
         std::ranges::all_of(entries, [](const IndexEntry& entry) { return entry.time_s == std::floor(entry.time_s); });
}

}  // namespace

TumIndex readTumIndex(const fs::path& folder, const fs::path& file) {
  const std::string where = file.string();
  CsvReader rows(file, CsvReader::kBlanks);
  TumIndex index;
  std::vector<IndexEntry>& entries = index.entries;
  std::size_t column = 0;
  std::size_t repeated = 0;
  std::string first_repeated;
  while (rows.next()) {
    if (entries.empty()) column = timeColumn(rows, folder, where);
    if (rows.fieldCount() < column + 2) rows.fail("has fewer fields than the rows before");
    const double time_s = rows.number(column);
    fs::path picture = pathInside(folder, rows.field(column + 1), where);
    if (!entries.empty() && time_s == entries.back().time_s) {
      if (repeated++ == 0) first_repeated = picture.filename().string();
      continue;
    }
    if (!entries.empty() && time_s < entries.back().time_s) rows.fail("times must grow from row to row");
    entries.push_back({static_cast<std::int64_t>(entries.size()), time_s, std::move(picture)});
  }
  if (entries.empty()) throw Error("the recording has no frame", where);
  if (repeated > 0) {
    index.guesses.push_back(fmt::format("{}: {} {} the time of the row before and {} passed over, {} first", where,
                                        repeated, repeated == 1 ? "row has" : "rows have", repeated == 1 ? "is" : "are",
                                        first_repeated));
  }
  if (areNumbers(entries)) {
    for (IndexEntry& entry : entries) entry.time_s /= kNumberedFps;
    index.guesses.push_back(
        fmt::format("{}: its times are whole numbers from {:g} on, taken for frames at {:g} a second", where,
                    kNumberedFps * entries.front().time_s, kNumberedFps));
  }
  index.fps = frameRate(stepsOf(entries));
  return index;
}

}  // namespace depthmocap

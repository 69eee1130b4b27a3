#include "libtracker/recording/track_rows.h"

#include <fmt/format.h>

namespace depthmocap {
namespace {

constexpr std::string_view kPersonColumn = "person";

}  // namespace

TrackState parseState(const CsvReader& csv, std::string_view text) {
  for (const TrackState state : {TrackState::Tracking, TrackState::Coasting, TrackState::Lost}) {
    if (text == trackStateName(state)) return state;
  }
  csv.fail("state must be tracking, coasting or lost");
}

std::string personHeader(FileOf kind) {
  return kind == FileOf::People ? fmt::format(",{}", kPersonColumn) : std::string();
}

std::string personField(FileOf kind, TrackState state, int person) {
  if (kind == FileOf::OneActor) return {};
  return state == TrackState::Lost ? "," : fmt::format(",{}", person);
}

WhoseRow::WhoseRow(const CsvReader& csv, int person) : person_(person) {
  for (std::size_t i = 0; i < csv.fieldCount(); ++i) {
    if (csv.field(i) == kPersonColumn) column_ = i;
  }
}

bool WhoseRow::wanted(const CsvReader& csv) const {
  if (!column_) return true;
  if (*column_ >= csv.fieldCount() || csv.field(*column_).empty()) return false;  // nobody was there
  return csv.integer(*column_) == person_;
}

}  // namespace depthmocap

#include "libtracker/clinical/angles_file.h"

#include <array>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "libtracker/core/csv.h"
#include "libtracker/core/row_file.h"
#include "libtracker/recording/track_rows.h"

namespace depthmocap {
namespace {

constexpr std::size_t kFirstColumn = 3;  // after frame, time_s, state

struct SignalColumn {
  const char* name;
  double BodySignals::*value;
};
constexpr std::array<SignalColumn, 5> kSignals = {{{"pelvis_y_m", &BodySignals::pelvis_y_m},
                                                   {"left_sole_y_m", &BodySignals::left_sole_y_m},
                                                   {"right_sole_y_m", &BodySignals::right_sole_y_m},
                                                   {"left_foot_ahead_m", &BodySignals::left_foot_ahead_m},
                                                   {"right_foot_ahead_m", &BodySignals::right_foot_ahead_m}}};

std::vector<std::string> columns() {
  std::vector<std::string> names = {"frame", "time_s", "state"};
  names.insert(names.end(), kClinicalAngleNames.begin(), kClinicalAngleNames.end());
  for (const std::string_view joint : kClinicalJointNames) names.push_back(std::string(joint) + "_c");
  for (const SignalColumn& signal : kSignals) names.emplace_back(signal.name);
  return names;
}

std::string line(const AnglesRow& row, FileOf kind) {
  std::string text = fmt::format("{},{:.6f},{}", row.frame, row.time_s, trackStateName(row.state));
  const auto out = std::back_inserter(text);
  const bool lost = row.state == TrackState::Lost;
  if (lost) {
    text += std::string(kClinicalAngleCount, ',');
  } else {
    for (const double angle : row.angles) fmt::format_to(out, ",{:.4f}", angle);
  }
  for (const double c : row.confidence) fmt::format_to(out, ",{:.3f}", lost ? 0.0 : c);
  if (lost) {
    text += std::string(kSignals.size(), ',');
  } else {
    for (const SignalColumn& signal : kSignals) fmt::format_to(out, ",{:.5f}", row.signals.*signal.value);
  }
  return text + personField(kind, row.state, row.person) + "\n";
}

}  // namespace

struct AnglesWriter::Impl : RowFile {
  Impl(const std::filesystem::path& path, FileOf file_of)
      : RowFile(path, fmt::format("{}{}\n", fmt::join(columns(), ","), personHeader(file_of))), kind(file_of) {}
  const FileOf kind;
};

AnglesWriter::AnglesWriter(const std::filesystem::path& path, FileOf kind)
    : impl_(std::make_unique<Impl>(path, kind)) {}
AnglesWriter::~AnglesWriter() = default;

void AnglesWriter::write(const AnglesRow& row) {
  impl_->write(line(row, impl_->kind));
}

void AnglesWriter::finish() {
  impl_->finish();
}

AnglesRow anglesRow(const TrackedFrame& tracked, ClinicalAngleReader& reader) {
  AnglesRow row;
  row.person = tracked.person;
  row.frame = tracked.frame;
  row.time_s = tracked.time_s;
  row.state = tracked.state;
  if (tracked.state == TrackState::Lost) return row;
  const Skeleton skeleton = makeSkeleton(tracked.lengths);
  ForwardKinematics fk;
  fk.update(skeleton, tracked.q);
  row.angles = reader.read(fk);
  row.confidence = clinicalConfidence(tracked.confidence);
  row.signals = bodySignals(fk, skeleton);
  return row;
}

std::vector<AnglesRow> readAnglesFile(const std::filesystem::path& path, int person) {
  CsvReader csv(path);
  csv.readHeader(columns());
  const WhoseRow whose(csv, person);
  std::vector<AnglesRow> rows;
  while (csv.next()) {
    if (!whose.wanted(csv)) continue;
    auto row = startRow(csv, rows);
    row.state = parseState(csv, csv.field(2));
    row.person = person;
    if (row.state != TrackState::Lost) {
      std::size_t column = kFirstColumn;
      for (double& angle : row.angles) angle = csv.number(column++);
      for (double& c : row.confidence) c = csv.number(column++);
      for (const SignalColumn& signal : kSignals) row.signals.*signal.value = csv.number(column++);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace depthmocap

#include "libtracker/recording/track_files.h"

#include <iterator>
#include <optional>

#include <fmt/format.h>

#include "depthmocap/world_frame.h"
#include "libtracker/core/check.h"
#include "libtracker/core/csv.h"
#include "libtracker/core/row_file.h"
#include "libtracker/recording/track_rows.h"

namespace depthmocap {

namespace {

constexpr std::size_t kFirstJointColumn = 3;  // after frame, time_s, state
constexpr std::size_t kColumnsPerJoint = 4;   // x y z c
constexpr std::size_t kFirstDofColumn = 2;    // after frame, time_s

// The comment line that names a world frame: how its points (x, y, z) lie in the camera's.
std::string worldFrameComment(const Eigen::Matrix3d& R_world_camera) {
  std::string p_camera = "x, -y, -z";
  if (R_world_camera != uprightWorldFromCamera()) {
    const auto row = [&](int axis) {
      const Eigen::Vector3d r = R_world_camera.col(axis);
      return fmt::format("{:.6f} x {:+.6f} y {:+.6f} z", r.x(), r.y(), r.z());
    };
    p_camera = fmt::format("{}, {}, {}", row(0), row(1), row(2));
  }
  return fmt::format("# world frame: y up, x right, z towards the camera; metres, radians; p_camera = ({})\n",
                     p_camera);
}

std::vector<std::string> jointsColumns() {
  std::vector<std::string> columns = {"frame", "time_s", "state"};
  for (const std::string_view joint : kJointNames) {
    for (const char* suffix : {"_x", "_y", "_z", "_c"}) columns.push_back(std::string(joint) + suffix);
  }
  return columns;
}

std::vector<std::string> poseColumns() {
  std::vector<std::string> columns = {"frame", "time_s"};
  columns.insert(columns.end(), kDofNames.begin(), kDofNames.end());
  return columns;
}

void readJointPositions(const CsvReader& csv, JointsRow& row) {
  for (int joint = 0; joint < kJointCount; ++joint) {
    const std::size_t column = kFirstJointColumn + kColumnsPerJoint * static_cast<std::size_t>(joint);
    for (int axis = 0; axis < 3; ++axis) {
      row.p_camera(axis, joint) = csv.number(column + static_cast<std::size_t>(axis));
    }
    row.confidence[joint] = csv.number(column + 3);
    if (row.confidence[joint] < 0 || row.confidence[joint] > 1) csv.fail("a confidence lies outside [0, 1]");
  }
}

}  // namespace

std::vector<JointsRow> readJointsFile(const std::filesystem::path& path, int person) {
  CsvReader csv(path);
  csv.readHeader(jointsColumns());
  const WhoseRow whose(csv, person);
  std::vector<JointsRow> rows;
  while (csv.next()) {
    if (!whose.wanted(csv)) continue;
    auto row = startRow(csv, rows);
    row.state = parseState(csv, csv.field(2));
    row.person = person;
    if (row.state != TrackState::Lost) readJointPositions(csv, row);
    rows.push_back(row);
  }
  return rows;
}

std::vector<PoseRow> readPoseFile(const std::filesystem::path& path, int person) {
  CsvReader csv(path);
  csv.readHeader(poseColumns());
  const WhoseRow whose(csv, person);
  std::vector<PoseRow> rows;
  while (csv.next()) {
    if (!whose.wanted(csv)) continue;
    auto row = startRow(csv, rows);
    row.person = person;
    for (int i = 0; i < kDofCount; ++i) row.q[i] = csv.number(kFirstDofColumn + static_cast<std::size_t>(i));
    rows.push_back(row);
  }
  return rows;
}

struct JointsWriter::Impl : RowFile {
  Impl(const std::filesystem::path& path, FileOf file_of) : RowFile(path, jointsHeader(file_of)), kind(file_of) {}
  const FileOf kind;
};

struct PoseWriter::Impl : RowFile {
  Impl(const std::filesystem::path& path, FileOf file_of) : RowFile(path, ""), kind(file_of) {}

  void nameWorld(const Eigen::Matrix3d& R_world_camera) {
    if (named && *named == R_world_camera) return;
    std::string text = worldFrameComment(R_world_camera);
    if (!named) text += fmt::format("{}{}\n", fmt::join(poseColumns(), ","), personHeader(kind));
    write(text);
    named = R_world_camera;
  }

  const FileOf kind;
  std::optional<Eigen::Matrix3d> named;
};

JointsRow jointsRow(const TrackedFrame& tracked) {
  JointsRow row;
  row.person = tracked.person;
  row.frame = tracked.frame;
  row.time_s = tracked.time_s;
  row.state = tracked.state;
  if (tracked.state == TrackState::Lost) return row;
  row.p_camera = tracked.joints_camera;
  row.confidence = tracked.confidence;
  return row;
}

std::string jointsHeader(FileOf kind) {
  return fmt::format("{}{}\n", fmt::join(jointsColumns(), ","), personHeader(kind));
}

JointsWriter::JointsWriter(const std::filesystem::path& path, FileOf kind)
    : impl_(std::make_unique<Impl>(path, kind)) {}
JointsWriter::~JointsWriter() = default;

std::string jointsLine(const JointsRow& row, FileOf kind) {
  DMC_CHECK(row.p_camera.allFinite() && row.confidence.allFinite());
  std::string text = fmt::format("{},{:.6f},{}", row.frame, row.time_s, trackStateName(row.state));
  for (int joint = 0; joint < kJointCount; ++joint) {
    if (row.state == TrackState::Lost) {
      text += ",,,,0";
    } else {
      const auto p = row.p_camera.col(joint);
      fmt::format_to(std::back_inserter(text), ",{:.6f},{:.6f},{:.6f},{:.3f}", p.x(), p.y(), p.z(),
                     row.confidence[joint]);
    }
  }
  return text + personField(kind, row.state, row.person) + "\n";
}

void JointsWriter::write(const JointsRow& row) {
  impl_->write(jointsLine(row, impl_->kind));
}

void JointsWriter::finish() {
  impl_->finish();
}

PoseWriter::PoseWriter(const std::filesystem::path& path, FileOf kind) : impl_(std::make_unique<Impl>(path, kind)) {}
PoseWriter::~PoseWriter() = default;

void PoseWriter::write(const PoseRow& row) {
  DMC_CHECK(row.q.allFinite());
  impl_->nameWorld(row.R_world_camera);
  std::string text = fmt::format("{},{:.6f}", row.frame, row.time_s);
  for (int i = 0; i < kDofCount; ++i) fmt::format_to(std::back_inserter(text), ",{:.6f}", row.q[i]);
  impl_->write(text + personField(impl_->kind, TrackState::Tracking, row.person) + "\n");
}

void PoseWriter::finish() {
  if (!impl_->named) impl_->nameWorld(uprightWorldFromCamera());
  impl_->finish();
}

}  // namespace depthmocap

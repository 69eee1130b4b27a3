#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "depthmocap/camera_model.h"
#include "depthmocap/joints.h"
#include "depthmocap/pose.h"
#include "depthmocap/track_state.h"
#include "depthmocap/tracked_frame.h"
#include "depthmocap/world_frame.h"

namespace depthmocap {

// One row of a joints file: joint centres in the camera frame [m] with confidence in [0, 1].
// A lost row has no positions (all zero here, empty in the file).
struct JointsRow {
  std::int64_t frame = 0;
  double time_s = 0;
  TrackState state = TrackState::Lost;
  JointPositions p_camera = JointPositions::Zero();
  Eigen::Matrix<double, kJointCount, 1> confidence = Eigen::Matrix<double, kJointCount, 1>::Zero();
  int person = 1;  // number; in files of several people only
};

// One row of a pose file: q in a world frame with the camera at its origin and y up, which a comment line before the
// row names. Readers of the file leave the world at its default.
struct PoseRow {
  std::int64_t frame = 0;
  double time_s = 0;
  Pose q = Pose::Zero();
  Eigen::Matrix3d R_world_camera = uprightWorldFromCamera();
  int person = 1;  // number; in files of several people only
};

// What a joints file says about a tracked frame.
JointsRow jointsRow(const TrackedFrame& tracked);
// Whether a file of rows is of one actor, or of several people with a last column `person`.
enum class FileOf { OneActor, People };
// The lines of a joints file, with their ends: its header, and a row. A lost row has no person.
std::string jointsHeader(FileOf kind = FileOf::OneActor);
std::string jointsLine(const JointsRow& row, FileOf kind = FileOf::OneActor);

// Of several people a file has one row a frame for each who is there; the rows of one person are read. Columns beyond
// the known ones and lines that start with # are skipped. A damaged row (too few fields, no number, frame numbers or
// times that do not grow, a confidence outside [0, 1]) throws Error with file and line. Truth and reference files of a
// recording have the same form.
std::vector<JointsRow> readJointsFile(const std::filesystem::path& path, int person = 1);
std::vector<PoseRow> readPoseFile(const std::filesystem::path& path, int person = 1);

// Row by row into a temporary file beside `path`; finish() renames it into place, the destructor without finish() too
// if any row was written, so that what was tracked before a failure is kept.
class JointsWriter {
 public:
  explicit JointsWriter(const std::filesystem::path& path, FileOf kind = FileOf::OneActor);
  ~JointsWriter();
  void write(const JointsRow& row);
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// A lost frame writes no row; frame numbers say which are missing. The file begins with the comment line that names the
// world of its first row; where a later row is in another world, such a line stands before it.
class PoseWriter {
 public:
  explicit PoseWriter(const std::filesystem::path& path, FileOf kind = FileOf::OneActor);
  ~PoseWriter();
  void write(const PoseRow& row);
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace depthmocap

#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/stl/filesystem.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/frame_stream.h"
#include "libtracker/recording/track_files.h"

namespace py = pybind11;
using namespace py::literals;

namespace depthmocap {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Numbers, times and states of rows, as every reader gives them.
template <typename Rows>
py::dict stampsOf(const Rows& rows) {
  const auto count = static_cast<py::ssize_t>(rows.size());
  py::array_t<std::int64_t> frame(count);
  py::array_t<double> time_s(count);
  for (py::ssize_t i = 0; i < count; ++i) {
    frame.mutable_at(i) = rows[static_cast<std::size_t>(i)].frame;
    time_s.mutable_at(i) = rows[static_cast<std::size_t>(i)].time_s;
  }
  return py::dict("frame"_a = frame, "time_s"_a = time_s);
}

py::dict readJoints(const std::filesystem::path& path, int person) {
  const std::vector<JointsRow> rows = readJointsFile(path, person);
  const auto count = static_cast<py::ssize_t>(rows.size());
  py::dict track = stampsOf(rows);
  py::list states;
  py::array_t<double> joints({count, py::ssize_t{kJointCount}, py::ssize_t{3}});
  py::array_t<double> confidence({count, py::ssize_t{kJointCount}});
  double* to_joints = joints.mutable_data();
  double* to_confidence = confidence.mutable_data();
  for (const JointsRow& row : rows) {
    states.append(std::string(trackStateName(row.state)));
    JointPositions p = row.p_camera;
    if (row.state == TrackState::Lost) p.setConstant(kNaN);
    to_joints = std::copy_n(p.data(), p.size(), to_joints);
    to_confidence = std::copy_n(row.confidence.data(), row.confidence.size(), to_confidence);
  }
  track["state"] = states;
  track["joints"] = joints;
  track["confidence"] = confidence;
  return track;
}

py::dict readPoses(const std::filesystem::path& path, int person) {
  const std::vector<PoseRow> rows = readPoseFile(path, person);
  py::dict track = stampsOf(rows);
  py::array_t<double> q({static_cast<py::ssize_t>(rows.size()), py::ssize_t{kDofCount}});
  double* to = q.mutable_data();
  for (const PoseRow& row : rows) to = std::copy_n(row.q.data(), row.q.size(), to);
  track["q"] = q;
  return track;
}

void writeJoints(const std::filesystem::path& path, const py::iterable& frames) {
  JointsWriter writer(path);
  for (const py::handle frame : frames) writer.write(jointsRow(frame.cast<const KeptFrame&>().tracked));
  writer.finish();
}

void writePoses(const std::filesystem::path& path, const py::iterable& frames) {
  PoseWriter writer(path);
  for (const py::handle frame : frames) {
    const TrackedFrame& t = frame.cast<const KeptFrame&>().tracked;
    if (t.state != TrackState::Lost) writer.write({t.frame, t.time_s, t.q, t.R_world_camera, t.person});
  }
  writer.finish();
}

}  // namespace

void bindTracks(py::module_& module) {
  module.def("read_joints", &readJoints, "path"_a, "person"_a = 1,
             "A joints file: a dict of arrays over the rows: frame, time_s, state (list of str), joints (rows, 18, 3) "
             "in metres,\n"
             "NaN where lost, and confidence (rows, 18).");
  module.def("read_pose", &readPoses, "path"_a, "person"_a = 1,
             "A pose file: a dict of arrays over the rows: frame, time_s and q (rows, 36) in metres and radians.");
  module.def("write_joints", &writeJoints, "path"_a, "frames"_a,
             "Writes Frames of one person as a joints file, the same bytes as `depthmocap replay --joints`.");
  module.def("write_pose", &writePoses, "path"_a, "frames"_a,
             "Writes Frames of one person as a pose file, the same bytes as `depthmocap replay --pose`.");
}

}  // namespace depthmocap

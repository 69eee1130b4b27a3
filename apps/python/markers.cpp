#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "libtracker/core/shipped_files.h"
#include "libtracker/marker_files/marker_files.h"
#include "libtracker/repair/repair.h"
#include "libtracker/skeleton/forward_kinematics.h"

namespace py = pybind11;
using namespace py::literals;

namespace depthmocap {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> names(const MarkerSequence& markers) {
  std::vector<std::string> all;
  for (const MarkerTrack& track : markers.tracks) all.push_back(track.name);
  return all;
}

py::array_t<double> positions(const MarkerSequence& markers) {
  const auto frames = static_cast<py::ssize_t>(markers.frames());
  py::array_t<double> all({frames, static_cast<py::ssize_t>(markers.tracks.size()), py::ssize_t{3}});
  auto to = all.mutable_unchecked<3>();
  for (py::ssize_t m = 0; m < to.shape(1); ++m) {
    const MarkerTrack& track = markers.tracks[static_cast<std::size_t>(m)];
    for (py::ssize_t t = 0; t < frames; ++t) {
      for (py::ssize_t axis = 0; axis < 3; ++axis) to(t, m, axis) = track.seen[t] ? track.p(axis, t) : kNaN;
    }
  }
  return all;
}

using Positions = py::array_t<double, py::array::c_style | py::array::forcecast>;

MarkerSequence makeMarkers(const std::vector<std::string>& marker_names, const Positions& p, double fps) {
  requireShape(p, {-1, static_cast<py::ssize_t>(marker_names.size()), 3}, "positions");
  if (!(fps > 0)) throw Error("must be above 0", "fps");
  MarkerSequence markers;
  markers.fps = fps;
  for (py::ssize_t t = 0; t < p.shape(0); ++t) {
    markers.frame.push_back(t);
    markers.time_s.push_back(static_cast<double>(t) / fps);
  }
  markers.addTracks(marker_names);
  const auto from = p.unchecked<3>();
  for (py::ssize_t m = 0; m < from.shape(1); ++m) {
    MarkerTrack& track = markers.tracks[static_cast<std::size_t>(m)];
    for (py::ssize_t t = 0; t < from.shape(0); ++t) {
      const Eigen::Vector3d place(from(t, m, 0), from(t, m, 1), from(t, m, 2));
      track.seen[t] = place.allFinite();
      if (track.seen[t]) track.p.col(t) = place;
    }
  }
  return markers;
}

void writeMarkers(const MarkerSequence& markers, const std::filesystem::path& path) {
  switch (markerFileKind(path)) {
    case MarkerFileKind::Trc:
      return writeTrc(markers, path);
    case MarkerFileKind::C3d:
      return writeC3d(markers, path);
    case MarkerFileKind::JointsCsv:
      throw Error("is a joints file", path.string(), "name a .trc or .c3d file, or use write_joints()");
  }
}

RepairResult repairMarkers(const MarkerSequence& markers, std::optional<double> noise, int threads) {
  RepairConfig config;
  config.noise_m = noise;
  config.sequence.threads = threads;
  const py::gil_scoped_release released;
  return repair(markers, std::make_shared<const LearnedPoses>(loadLearnedPoses(shippedFile("pose_priors.bin"))),
                config);
}

py::array_t<double> bodyJoints(const RepairResult& result) {
  Eigen::Matrix3Xd all(3, static_cast<Eigen::Index>(result.poses.size()) * kJointCount);
  for (std::size_t t = 0; t < result.poses.size(); ++t) {
    all.middleCols<kJointCount>(static_cast<Eigen::Index>(t) * kJointCount) =
        result.R_world_file.transpose() * jointPositions(result.body.skeleton, result.poses[t]);
  }
  return arrayOf(all, {static_cast<py::ssize_t>(result.poses.size()), kJointCount, 3});
}

py::array_t<double> poses(const RepairResult& result) {
  Eigen::Matrix<double, kDofCount, Eigen::Dynamic> all(kDofCount, static_cast<Eigen::Index>(result.poses.size()));
  for (std::size_t t = 0; t < result.poses.size(); ++t) all.col(static_cast<Eigen::Index>(t)) = result.poses[t];
  return arrayOf(all, {static_cast<py::ssize_t>(result.poses.size()), kDofCount});
}

}  // namespace

void bindMarkers(py::module_& module) {
  py::class_<MarkerSequence>(module, "Markers", "Markers or joints over time.")
      .def(py::init(&makeMarkers), "names"_a, "positions"_a, py::kw_only(), "fps"_a = 30.0,
           "positions: shape (frames, markers, 3), metres, NaN where not seen.")
      .def_static("load", &readMarkers, "path"_a, "Reads a joints file (.csv), .trc or .c3d.")
      .def("save", &writeMarkers, "path"_a, "Writes .trc or .c3d.")
      .def_property_readonly("names", &names, "Of the markers.")
      .def_property_readonly("positions", &positions,
                             "Shape (frames, markers, 3), metres, in the file's frame; NaN where not seen.")
      .def_property_readonly(
          "times",
          [](const MarkerSequence& m) {
            return py::array_t<double>(static_cast<py::ssize_t>(m.time_s.size()), m.time_s.data());
          },
          "Seconds: shape (frames,).")
      .def_readonly("fps", &MarkerSequence::fps, "Frames per second.");
  py::class_<RepairResult>(module, "Repaired", "What repair() gives.")
      .def_readonly("markers", &RepairResult::markers, "Markers of the input, in its frame; all seen or filled.")
      .def_property_readonly(
          "joints", &bodyJoints,
          "Joint centres (JOINTS) of the fitted body: shape (frames, 18, 3), metres, in the file's frame.")
      .def_property_readonly("q", &poses, "Degrees of freedom (DOFS): shape (frames, 36), metres and radians, y up.")
      .def_readonly("outliers", &RepairResult::outliers, "Samples that were taken for wrong.")
      .def_readonly("noise", &RepairResult::noise_m, "Median over the markers, metres.")
      .def_readonly("loose", &RepairResult::loose,
                    "Names of markers that are on no bone: only their gaps were closed.");
  module.def(
      "repair", &repairMarkers, "markers"_a, py::kw_only(), "noise"_a = py::none(), "threads"_a = 2,
      "Fills gaps and removes noise with a body, its prior and smoothness: Repaired. noise: deviation of each\n"
      "coordinate in metres; default measured, marker by marker. Raises Error where fewer than four names are known.");
}

}  // namespace depthmocap

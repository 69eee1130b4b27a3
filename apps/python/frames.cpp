#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <string>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/frame_stream.h"
#include "apps/python/rotations.h"

namespace py = pybind11;
using namespace py::literals;

namespace depthmocap {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool isLost(const KeptFrame& frame) {
  return frame.tracked.state == TrackState::Lost;
}

py::array_t<double> joints(const KeptFrame& frame) {
  JointPositions p = frame.tracked.joints_camera;
  if (isLost(frame)) p.setConstant(kNaN);
  return arrayOf(p, {kJointCount, 3});
}

py::array_t<double> pose(const KeptFrame& frame) {
  Pose q = frame.tracked.q;
  if (isLost(frame)) q.setConstant(kNaN);
  return arrayOf(q, {kDofCount});
}

py::array_t<double> rotations(const KeptFrame& frame) {
  Quaternions all = boneRotations(frame.tracked.q);
  if (isLost(frame)) all.setConstant(kNaN);
  return arrayOf(all, {kBoneCount, 4});
}

py::array_t<double> markers(const MarkerSet& set) {
  auto p = set.position;
  for (int part = 0; part < kPartCount; ++part) {
    if (!set.seen(part)) p.col(part).setConstant(kNaN);
  }
  return arrayOf(p, {kPartCount, 3});
}

py::object floorPlane(const KeptFrame& frame) {
  if (!frame.tracked.floor_world) return py::none();
  return arrayOf(*frame.tracked.floor_world, {4});
}

py::dict stageTimes(const KeptFrame& frame) {
  const StageTimes& ms = frame.tracked.ms;
  return py::dict("segment"_a = ms.segment, "classify"_a = ms.classify, "markers"_a = ms.markers, "prior"_a = ms.prior,
                  "solve"_a = ms.solve, "total"_a = ms.total);
}

std::string text(const KeptFrame& frame) {
  return py::str("<Frame {} at {:.3f} s, {}>")
      .format(frame.tracked.frame, frame.tracked.time_s, std::string(trackStateName(frame.tracked.state)));
}

}  // namespace

void bindFrames(py::module_& module) {
  py::class_<KeptFrame, std::shared_ptr<KeptFrame>>(
      module, "Frame", "What tracking says of one person in one depth picture. Arrays are copies.")
      .def_property_readonly(
          "frame", [](const KeptFrame& f) { return f.tracked.frame; }, "Number in the recording.")
      .def_property_readonly(
          "time_s", [](const KeptFrame& f) { return f.tracked.time_s; }, "Sensor time, seconds.")
      .def_property_readonly(
          "person", [](const KeptFrame& f) { return f.tracked.person; }, "Number of the person, from 1.")
      .def_property_readonly(
          "state", [](const KeptFrame& f) { return std::string(trackStateName(f.tracked.state)); },
          "'tracking', 'coasting' (nothing seen, the last pose is kept for a moment) or 'lost'.")
      .def_property_readonly("joints", &joints,
                             "Joint centres (JOINTS): shape (18, 3), metres, camera frame; NaN where lost.")
      .def_property_readonly(
          "confidence", [](const KeptFrame& f) { return arrayOf(f.tracked.confidence, {kJointCount}); },
          "Of each joint: shape (18,), 0 (not observed) to 1.")
      .def_property_readonly(
          "q", &pose, "Degrees of freedom (DOFS): shape (36,), metres and radians, in the world; NaN where lost.")
      .def_property_readonly(
          "rotations", &rotations,
          "Rotation of each bone (BONES) in its parent: shape (16, 4), quaternions w x y z, the identity in\n"
          "the T-pose; the root's is in the world. NaN where lost.")
      .def_property_readonly(
          "world_from_camera",
          [](const KeptFrame& f) {
            return arrayOf(Eigen::Matrix3d(f.tracked.R_world_camera.transpose()), {3, 3});
          },
          "Shape (3, 3): p_world = world_from_camera @ p_camera; the world has y up and the camera's origin.")
      .def_property_readonly("floor", &floorPlane,
                             "Plane of the floor in the world, n and d of n.p + d = 0: shape (4,), or None.")
      .def_property_readonly(
          "markers", [](const KeptFrame& f) { return markers(f.tracked.markers_camera); },
          "Marker of each body part (PARTS[1:]): shape (15, 3), metres, camera frame; NaN where not seen.")
      .def_property_readonly(
          "marker_confidence",
          [](const KeptFrame& f) { return arrayOf(f.tracked.markers_camera.confidence, {kPartCount}); },
          "Shape (15,), 0 (not seen) to 1.")
      .def_property_readonly(
          "labels", [](const KeptFrame& f) { return arrayOf(f.tracked.labels); },
          "Body part (index in PARTS) of each pixel: uint8 of shape (height, width), 0 outside the person.")
      .def_property_readonly(
          "depth", [](const KeptFrame& f) { return arrayOf(f.depth); },
          "The depth picture: float32 of shape (height, width), metres, 0 = no measurement.")
      .def_property_readonly(
          "stature", [](const KeptFrame& f) { return f.tracked.stature_m; }, "Of the body in use, metres.")
      .def_property_readonly(
          "reinitialised", [](const KeptFrame& f) { return f.tracked.reinitialised; },
          "Whether the pose comes from a search over all poses, not from the frame before.")
      .def_property_readonly("stage_ms", &stageTimes,
                             "Milliseconds of each stage: segment, classify, markers, prior, solve, total.")
      .def("__repr__", &text);
}

}  // namespace depthmocap

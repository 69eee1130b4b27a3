#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "depthmocap/camera.h"
#include "depthmocap/recording.h"
#include "libtracker/core/check_camera.h"
#include "libtracker/recording/recording.h"
#include "libtracker/recording/recording_header.h"

namespace py = pybind11;
using namespace py::literals;

namespace depthmocap {
namespace {

CameraModel makeCamera(int width, int height, double fx, double fy, double cx, double cy,
                       const std::array<double, 5>& distortion) {
  const CameraModel camera{width, height, fx, fy, cx, cy, distortion};
  checkCamera(camera, "CameraModel");
  return camera;
}

std::string cameraText(const CameraModel& c) {
  return py::str("CameraModel(width={}, height={}, fx={}, fy={}, cx={}, cy={})")
      .format(c.width, c.height, c.fx, c.fy, c.cx, c.cy);
}

py::array_t<float> readFrame(Recording& recording, py::ssize_t i) {
  const auto count = static_cast<py::ssize_t>(recording.frameCount());
  if (i < 0) i += count;
  if (i < 0 || i >= count) throw py::index_error("there are " + std::to_string(count) + " frames");
  DepthFrame frame;
  {
    const py::gil_scoped_release released;
    recording.read(static_cast<std::size_t>(i), frame);
  }
  return arrayOf(frame.depth);
}

py::array_t<double> times(const Recording& recording) {
  py::array_t<double> all(static_cast<py::ssize_t>(recording.frameCount()));
  for (std::size_t i = 0; i < recording.frameCount(); ++i)
    all.mutable_at(static_cast<py::ssize_t>(i)) = recording.time_s(i);
  return all;
}

// Counts the frames by itself where the caller does not.
class Writer {
 public:
  Writer(const std::filesystem::path& path, const CameraModel& camera, double fps, double depth_unit_m,
         const std::string& name)
      : writer_(std::make_unique<RecordingWriter>(path, RecordingInfo{camera, fps, depth_unit_m, name, "", "{}", {}})) {
  }
  void write(const DepthArray& depth, double time_s) {
    if (!writer_) throw Error("is finished", "RecordingWriter");
    const DepthFrame frame{next_, time_s, depthImageOf(depth)};
    const py::gil_scoped_release released;
    writer_->write(frame);
    ++next_;
  }
  void finish() {
    if (writer_) writer_->finish();
    writer_.reset();
  }

 private:
  std::unique_ptr<RecordingWriter> writer_;
  std::int64_t next_ = 0;
};

}  // namespace

void bindCameras(py::module_& module) {
  py::class_<CameraModel>(module, "CameraModel", "A pinhole camera; x right, y down, z forward. Pixels.")
      .def(py::init(&makeCamera), "width"_a, "height"_a, "fx"_a, "fy"_a, "cx"_a, "cy"_a,
           "distortion"_a = std::array<double, 5>{},
           "Size, focal lengths and centre in pixels; distortion k1 k2 p1 p2 k3 as in OpenCV.")
      .def_readonly("width", &CameraModel::width, "Of the pictures, pixels.")
      .def_readonly("height", &CameraModel::height, "Of the pictures, pixels.")
      .def_readonly("fx", &CameraModel::fx, "Focal length, pixels.")
      .def_readonly("fy", &CameraModel::fy, "Focal length, pixels.")
      .def_readonly("cx", &CameraModel::cx, "Of the optical axis, pixels.")
      .def_readonly("cy", &CameraModel::cy, "Of the optical axis, pixels.")
      .def_readonly("distortion", &CameraModel::distortion, "k1 k2 p1 p2 k3 as in OpenCV; all 0 = none.")
      .def("__repr__", &cameraText);

  py::class_<Recording>(module, "Recording",
                        "Depth pictures on disk: a depthmocap or TUM RGB-D folder, or an .oni file.")
      .def(py::init([](const std::filesystem::path& path, const std::filesystem::path& camera,
                       std::optional<double> depth_unit, int turn) {
             return Recording(path, CameraCorrection{camera, depth_unit, turn});
           }),
           "path"_a, py::kw_only(), "camera"_a = "", "depth_unit"_a = py::none(), "turn"_a = 0,
           "camera: a file with the intrinsics, as recording.json; depth_unit: metres per depth step; turn: degrees\n"
           "clockwise (0, 90, 180, 270) that make the pictures upright.")
      .def("__len__", &Recording::frameCount)
      .def("__getitem__", &readFrame, "i"_a,
           "Depth of frame i: float32 of shape (height, width), metres, 0 = no measurement.")
      .def_property_readonly("camera", &Recording::camera, "CameraModel of the pictures, without distortion.")
      .def_property_readonly("fps", &Recording::fps, "Nominal frames per second.")
      .def_property_readonly("times", &times, "Seconds of each frame: float64 of shape (frames,).");

  py::class_<Writer>(module, "RecordingWriter",
                     "Writes a recording folder; a context manager. Refuses to overwrite one.")
      .def(py::init<const std::filesystem::path&, const CameraModel&, double, double, const std::string&>(), "path"_a,
           "camera"_a, py::kw_only(), "fps"_a = 30.0, "depth_unit"_a = 0.001, "name"_a = "",
           "depth_unit: metres per stored step; name: of the camera.")
      .def("write", &Writer::write, "depth"_a, "time_s"_a,
           "Adds a picture: metres, shape (height, width), 0 or NaN = no measurement. Times must grow.")
      .def("finish", &Writer::finish, "Completes the recording; nothing may follow.")
      .def(
          "__enter__", [](Writer& writer) -> Writer& { return writer; }, py::return_value_policy::reference)
      .def("__exit__", [](Writer& writer, const py::args&) { writer.finish(); });

  module.def(
      "cameras",
      [] {
        std::vector<std::pair<std::string, std::string>> found;
        const py::gil_scoped_release released;
        for (const FoundCamera& camera : Camera::list()) found.emplace_back(camera.source, camera.name);
        return found;
      },
      "The cameras that are plugged in: a list of (source, name); the source is what live() takes.");
}

}  // namespace depthmocap

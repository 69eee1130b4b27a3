#include <filesystem>
#include <optional>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "depthmocap/actor.h"
#include "depthmocap/calibration.h"
#include "depthmocap/recording.h"

namespace py = pybind11;
using namespace py::literals;

namespace depthmocap {
namespace {

py::dict boneLengths(const Actor& actor) {
  const BoneLengths& l = actor.skeleton.lengths;
  return py::dict("upper_arm"_a = l.upper_arm, "lower_arm"_a = l.lower_arm, "upper_leg"_a = l.upper_leg,
                  "lower_leg"_a = l.lower_leg, "foot"_a = l.foot, "shoulder_width"_a = l.shoulder_width,
                  "hip_width"_a = l.hip_width, "torso"_a = l.torso, "neck_to_head"_a = l.neck_to_head);
}

Actor calibrate(const std::filesystem::path& path, std::optional<double> height, int frames, int threads) {
  const py::gil_scoped_release released;
  Recording recording(path);
  CalibrationOptions options;
  options.stature_m = height;
  options.frames = frames;
  options.threads = threads;
  options.camera_name = recording.cameraName();
  Calibration calibration(Models::shipped(), recording.camera(), options);
  const auto each = [&recording](const auto& visit) {
    DepthFrame frame;
    for (std::size_t i = 0; i < recording.frameCount(); ++i) {
      recording.read(i, frame);
      visit(frame);
    }
  };
  each([&calibration](const DepthFrame& frame) { calibration.add(frame); });
  return calibration.solve(each);
}

}  // namespace

void bindActors(py::module_& module) {
  py::class_<Actor>(module, "Actor", "A body to track.")
      .def_static("load", &readActorFile, "path"_a, "Reads an actor file, as `depthmocap calibrate` writes it.")
      .def_static("average", &averageActor, "stature"_a, "A body of average proportions, 1.0 to 2.2 metres tall.")
      .def(
          "save", [](const Actor& actor, const std::filesystem::path& path) { writeActorFile(path, actor); }, "path"_a,
          "Writes an actor file; only of a measured body.")
      .def_property_readonly("stature", &Actor::stature_m, "Standing height, metres.")
      .def_property_readonly("bone_lengths", &boneLengths, "Joint centre to joint centre, metres, by name.")
      .def("__repr__", [](const Actor& actor) { return py::str("<Actor of {:.3f} m>").format(actor.stature_m()); });
  module.def(
      "calibrate", &calibrate, "recording"_a, py::kw_only(), "height"_a = py::none(), "frames"_a = 10, "threads"_a = 2,
      "Measures the actor of a recording with a T-pose: an Actor. height: standing height in metres, if known, fixes\n"
      "the scale; frames: good frames of T-pose that are needed and used. Raises Error saying what to change.");
}

}  // namespace depthmocap

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "apps/python/arrays.h"
#include "apps/python/bindings.h"
#include "apps/python/frame_stream.h"
#include "depthmocap/tracker.h"
#include "libtracker/tracker/tracker_config.h"

namespace py = pybind11;
using namespace py::literals;

namespace depthmocap {
namespace {

constexpr std::size_t kWaitingFrames = 4;            // tracked ahead of who iterates over a recording; 1 MB each
constexpr std::chrono::milliseconds kPatience{100};  // between two looks for Ctrl-C

std::unique_ptr<FrameStream> track(const std::filesystem::path& recording, const std::optional<Actor>& actor,
                                   int people, std::optional<double> look_ahead, int passes, double smooth, int threads,
                                   const std::filesystem::path& camera, std::optional<double> depth_unit, int turn) {
  SessionOptions options;
  options.actor = actor;
  options.people = people;
  options.look_ahead_s = look_ahead;
  options.passes = passes;
  options.smooth = smooth;
  options.threads = threads;
  const py::gil_scoped_release released;
  return std::make_unique<FrameStream>(Recording(recording, {camera, depth_unit, turn}), options, kWaitingFrames);
}

std::unique_ptr<FrameStream> live(const std::string& source, const std::optional<Actor>& actor, int people,
                                  double smooth, double seconds, int threads, const std::filesystem::path& camera,
                                  std::optional<double> depth_unit, int turn, double speed) {
  SessionOptions options;
  options.actor = actor;
  options.people = people;
  options.smooth = smooth;
  options.seconds = seconds;
  options.threads = threads;
  CameraOptions camera_options;
  camera_options.speed = speed;
  camera_options.correction = {camera, depth_unit, turn};
  const py::gil_scoped_release released;
  return std::make_unique<FrameStream>(Camera(source, camera_options), options, 1);
}

// The next frame; Python's end of iteration after the last one.
std::shared_ptr<KeptFrame> next(FrameStream& stream) {
  for (;;) {
    const FrameStream::Taken taken = [&stream] {
      const py::gil_scoped_release released;
      return stream.take(kPatience);
    }();
    for (const std::string& warning : taken.warnings) {
      if (PyErr_WarnEx(PyExc_RuntimeWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
    }
    if (taken.frame) return taken.frame;
    if (taken.over) throw py::stop_iteration();
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

std::unique_ptr<Tracker> makeTracker(const CameraModel& camera, const std::optional<Actor>& actor, int people,
                                     int threads) {
  TrackerConfig config;
  config.people = people;
  config.threads = threads;
  const py::gil_scoped_release released;
  return std::make_unique<Tracker>(Models::shipped(), camera, config,
                                   actor ? std::optional(asSeen(*actor)) : std::nullopt);
}

// Tracks one picture; frames of everybody who is there, or one that is lost.
std::vector<std::shared_ptr<KeptFrame>> process(Tracker& tracker, const DepthArray& depth, double time_s,
                                                std::int64_t number) {
  const DepthFrame frame{number, time_s, depthImageOf(depth)};
  const py::gil_scoped_release released;
  const TrackedFrame& first = tracker.process(frame);
  std::vector<std::shared_ptr<KeptFrame>> frames;
  for (const TrackedFrame* person : tracker.people()) {
    if (person->state == TrackState::Lost) continue;
    frames.push_back(std::make_shared<KeptFrame>(KeptFrame{*person, frame.depth}));
  }
  if (frames.empty()) frames.push_back(std::make_shared<KeptFrame>(KeptFrame{first, frame.depth}));
  return frames;
}

constexpr const char* kTrackDoc =
    "Tracks a recording: an iterator of Frame, the same results as `depthmocap replay`. The work is done on a thread "
    "of\n"
    "its own, a few frames ahead. actor: a measured body; people: most that are tracked (1 to 6), a Frame for each who "
    "is\n"
    "there; look_ahead: seconds that each pose is steadied by before and after it (default 0.3, 0 = off);\n"
    "passes: 2 fits the body of a person without an actor over the first seconds before it tracks, 1 while tracking; "
    "smooth:\n"
    "0 to 1; camera, depth_unit, turn: as Recording. Raises Error.";

constexpr const char* kLiveDoc =
    "Tracks a camera: an iterator of Frame, until the camera's stream ends, `seconds` are over, or close(). source: "
    "'openni2',\n"
    "'v4l2:/dev/videoN', 'pipe:PATH', 'replay:REC'. The newest picture is tracked; what takes long between two frames "
    "costs\n"
    "pictures, never delay. speed: pace of a replay, 0 = as fast as it goes. Raises Error.";

}  // namespace

void bindTracking(py::module_& module) {
  py::class_<FrameStream>(module, "FrameStream", "Iterator of Frame.")
      .def(
          "__iter__", [](FrameStream& stream) -> FrameStream& { return stream; }, py::return_value_policy::reference)
      .def("__next__", &next)
      .def_property_readonly("camera", &FrameStream::camera, "The camera of the frames' depth, without distortion.")
      .def("close", &FrameStream::close, py::call_guard<py::gil_scoped_release>(),
           "Ends tracking; frames that are ready can still be taken.");
  module.def("track", &track, kTrackDoc, "recording"_a, py::kw_only(), "actor"_a = py::none(), "people"_a = 1,
             "look_ahead"_a = py::none(), "passes"_a = 2, "smooth"_a = 0.0, "threads"_a = 2, "camera"_a = "",
             "depth_unit"_a = py::none(), "turn"_a = 0);
  module.def("live", &live, kLiveDoc, "source"_a, py::kw_only(), "actor"_a = py::none(), "people"_a = 1,
             "smooth"_a = 0.0, "seconds"_a = 0.0, "threads"_a = 2, "camera"_a = "", "depth_unit"_a = py::none(),
             "turn"_a = 0, "speed"_a = 1.0);

  py::class_<Tracker>(module, "Tracker", "For pictures of your own: one depth picture in, its Frames out.")
      .def(py::init(&makeTracker), "camera"_a, py::kw_only(), "actor"_a = py::none(), "people"_a = 1, "threads"_a = 2)
      .def("process", &process, "depth"_a, "time_s"_a, "frame"_a = 0,
           "Tracks a picture: metres, shape (height, width) of the camera, undistorted, 0 or NaN = no measurement; "
           "seconds,\n"
           "growing. Returns a list of Frame, one for each person who is there, or one that is lost.")
      .def("reset", &Tracker::reset, "Forgets everybody.");
}

}  // namespace depthmocap

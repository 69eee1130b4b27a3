#include <pybind11/stl.h>

#include "apps/python/bindings.h"
#include "depthmocap/error.h"
#include "depthmocap/joints.h"
#include "depthmocap/parts.h"
#include "depthmocap/pose.h"
#include "depthmocap/skeleton.h"

namespace py = pybind11;
using namespace depthmocap;

PYBIND11_MODULE(_core, module) {
  module.doc() = "The C++ part of depthmocap.";
  module.attr("__version__") = DEPTHMOCAP_VERSION;
  module.attr("JOINTS") = py::tuple(py::cast(kJointNames));
  module.attr("PARTS") = py::tuple(py::cast(kPartNames));
  module.attr("BONES") = py::tuple(py::cast(kBoneNames));
  module.attr("DOFS") = py::tuple(py::cast(kDofNames));
  py::register_exception<Error>(module, "Error", PyExc_RuntimeError).doc() =
      "What a file, a device or an option has wrong: what, where and what to do.";
  bindCameras(module);
  bindFrames(module);
  bindActors(module);
  bindTracking(module);
  bindIk(module);
  bindMarkers(module);
  bindTracks(module);
}

#include "apps/python/arrays.h"

#include <cmath>

#include <fmt/format.h>

namespace depthmocap {

namespace py = pybind11;

void requireShape(const py::array& array, std::initializer_list<py::ssize_t> shape, const std::string& name) {
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size());
  std::string wanted;
  py::ssize_t axis = 0;
  for (const py::ssize_t length : shape) {
    fits = fits && (length < 0 || array.shape(axis) == length);
    wanted += (axis == 0 ? "" : ", ") + (length < 0 ? "any" : std::to_string(length));
    ++axis;
  }
  if (!fits) throw Error(fmt::format("must be an array of shape ({})", wanted), name);
}

DepthImage depthImageOf(const DepthArray& depth) {
  requireShape(depth, {-1, -1}, "depth");
  DepthImage image(static_cast<int>(depth.shape(1)), static_cast<int>(depth.shape(0)));
  const float* from = depth.data();
  for (float& to : image.data) {
    const float value = *from++;
    to = std::isfinite(value) && value > 0 ? value : 0.0F;
  }
  return image;
}

}  // namespace depthmocap

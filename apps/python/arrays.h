#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <initializer_list>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "depthmocap/error.h"
#include "depthmocap/image.h"

namespace depthmocap {

// An array of this shape with the values of a column-major Eigen matrix in memory order: a 3 x N matrix becomes N x 3.
template <typename Derived>
pybind11::array_t<double> arrayOf(const Eigen::PlainObjectBase<Derived>& matrix, std::vector<pybind11::ssize_t> shape) {
  pybind11::array_t<double> array(std::move(shape));
  std::copy_n(matrix.data(), matrix.size(), array.mutable_data());
  return array;
}

template <typename T>
pybind11::array_t<T> arrayOf(const Image<T>& image) {
  pybind11::array_t<T> array(
      {static_cast<pybind11::ssize_t>(image.height), static_cast<pybind11::ssize_t>(image.width)});
  std::copy(image.data.begin(), image.data.end(), array.mutable_data());
  return array;
}

// Throws Error unless the array has this shape; -1 is any length.
void requireShape(const pybind11::array& array, std::initializer_list<pybind11::ssize_t> shape,
                  const std::string& name);

// A depth picture [m] of shape (height, width); what is no positive number becomes 0, no measurement.
using DepthArray = pybind11::array_t<float, pybind11::array::c_style | pybind11::array::forcecast>;
DepthImage depthImageOf(const DepthArray& depth);

}  // namespace depthmocap

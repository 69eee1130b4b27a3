#pragma once
#include <Eigen/Core>
#include <cmath>
#include <nlohmann/json.hpp>

namespace depthmocap {

// Micrometres and microradians are enough.
inline double rounded(double value) {
  return std::round(value * 1e6) / 1e6;
}

inline nlohmann::json listOf(const Eigen::Vector3d& p) {
  return {rounded(p.x()), rounded(p.y()), rounded(p.z())};
}

}  // namespace depthmocap

#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "depthmocap/parts.h"

namespace depthmocap {

// How a measured point is compared with points of the body's surface.
struct PointLikelihood {
  double sigma_m;  // [m] (> 0) how far the surface is expected from a point of its part
  double reach_m;  // [m] (> 0) a point further from its surface point has no match
};

// What the classifier thinks against each part of one measured point, the likeliest part first.
struct PartDoubts {
  std::array<std::uint8_t, kPartCount> part;  // index of the part
  std::array<float, kPartCount> doubt;        // its negative log probability, rising

  // min_probability (0, 1]: no part is held less likely, for the classifier may be wrong.
  PartDoubts(const std::array<float, kPartCount>& probability, double min_probability);
};

// Points of the body's surface by part, to be searched for the one that a measured point most likely lies on. Reuse one
// object: nothing is allocated after its first calls.
class PartPoints {
 public:
  struct Found {
    std::size_t part;
    std::size_t index;  // of the point among those of its part, as added
  };

  void clear();
  void add(std::size_t part, const Eigen::Vector3f& p_world);  // [m]
  // To be called after the last add() and before find(); then clear() comes before the next add().
  void finish();

  // The point with the least cost for `p_world` [m]: half the squared distance over sigma^2, and the doubt of its part.
  // None: no point is in reach.
  [[nodiscard]] std::optional<Found> find(const Eigen::Vector3f& p_world, const PartDoubts& doubts,
                                          const PointLikelihood& likelihood) const;

 private:
  // Coordinates in blocks of kLanes, the last one filled up with points that are far from everything; and a sphere
  // around the points.
  struct Part {
    std::size_t count = 0;
    std::vector<float> x, y, z;
    Eigen::Vector3f centre = Eigen::Vector3f::Zero();
    float radius = 0;
  };
  [[nodiscard]] static std::size_t indexOf(const Part& part, const Eigen::Vector3f& p, float square);

  std::array<Part, kPartCount> parts_;
};

}  // namespace depthmocap

#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "libtracker/segment/components.h"

namespace depthmocap {

// Tells people apart who touch and are seen for the first time: a piece too large for one person is cut where its upper
// edge dips between two heads. Who is known already needs no cut: identities keep people apart.
class CrowdSplitter {
 public:
  // Cuts components of `found` until nothing more looks like two people. `up`: unit, camera frame; `known` as it was
  // given to found.find().
  void split(const CoarseCloud& cloud, const Eigen::Vector3f& up, std::span<const Identity> known,
             ComponentFinder& found);

 private:
  // Across the component [m]: everything beyond is the other one's; none where it is no crowd.
  std::optional<float> findCut(const CoarseCloud& cloud, const Eigen::Vector3f& up, const Eigen::Vector3f& across,
                               std::int32_t label, const ComponentFinder& found);

  // Of each strip across the component.
  std::vector<float> top_m_;
  std::vector<float> closed_top_m_;
  std::vector<float> area_m2_;
};

}  // namespace depthmocap

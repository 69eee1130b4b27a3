#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libtracker/segment/components.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {

// True when somebody has already removed the background: less than half of the image is measured, and every large
// component (15 % of the measured cells or more) fits into a person's box (2.4 m wide and high, 2 m deep). In a room
// the floor joins what stands on it into something larger, and walls do not fit.
bool looksCutOut(const CoarseCloud& cloud, const std::vector<Component>& components);

// What choosing needs to know about the frame.
struct ChoiceContext {
  bool cut_out = false;                        // the background is already removed: no test for a person's shape
  double min_area_cells = 1;                   // smaller components are no person
  const Eigen::Vector3d* predicted = nullptr;  // camera frame [m]; null = none
};

// Index of the component that is the actor: large in the image and near, shaped like a person, near the prediction.
// kNoComponent if there is none.
std::int32_t choosePerson(const std::vector<Component>& components, const SegmentConfig& config,
                          const ChoiceContext& context);

// Joins to the chosen component the pieces that belong to the same body but were cut off by a gap in the depth: close
// pieces that are no person of their own, and small pieces within an arm's length (hands; in a room only before the
// body).
class FragmentJoiner {
 public:
  // `selected` receives 1 per component that is part of the actor.
  void join(const CoarseCloud& cloud, const ComponentFinder& found, std::int32_t person, bool cut_out,
            std::vector<std::uint8_t>& selected);

 private:
  void samplePoints(const CoarseCloud& cloud, const ComponentFinder& found);
  [[nodiscard]] float gapBetween(std::int32_t a, std::int32_t b) const;
  [[nodiscard]] bool belongs(const std::vector<Component>& components, std::int32_t piece, float reach_m,
                             const std::vector<std::uint8_t>& selected) const;

  std::vector<std::vector<Eigen::Vector3f>> samples_;  // some points of each component
  std::vector<std::size_t> seen_;
};

}  // namespace depthmocap

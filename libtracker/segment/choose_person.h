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
  bool cut_out = false;                            // the background is already removed: no test for a person's shape
  double min_area_cells = 1;                       // smaller components are no person
  const Eigen::Vector3d* predicted = nullptr;      // camera frame [m]; null = none
  const std::vector<float>* box_shares = nullptr;  // of measureBoxShares; null where cut_out
};

// Index of the component that is the actor: large in the image and near, shaped like a person, near the prediction.
// kNoComponent if there is none.
std::int32_t choosePerson(const std::vector<Component>& components, const SegmentConfig& config,
                          const ChoiceContext& context);

}  // namespace depthmocap

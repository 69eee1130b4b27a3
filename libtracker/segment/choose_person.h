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
  bool cut_out = false;       // the background is already removed: no test for a person's shape, but flat things
  double min_area_cells = 1;  // smaller components are no person
  const ExpectedActor* expected = nullptr;  // null = anybody
  float usual_score = 0;                    // of the actor in the frames before
  float usual_area_m2 = 0;
  const std::vector<float>* box_shares = nullptr;  // of measureBoxShares; null where cut_out
};

// Which component is the actor.
struct Choice {
  std::int32_t person = kNoComponent;
  float score = 0;    // of that one's looks: large in the image and near, shaped like a person
  bool sure = false;  // no mere remnant of the actor
};

// Who is known to be the actor stays it, also while hidden in part, unless somebody else looks far more like a person
// than the actor usually does: then a thing was followed. If nobody is known to be the actor, or a small piece only:
// the one that looks most like a person near the expected place, but nobody who is known to be somebody else. `scores`
// receives the looks of each component.
Choice choosePerson(const std::vector<Component>& components, const SegmentConfig& config, const ChoiceContext& context,
                    std::vector<float>& scores);

}  // namespace depthmocap

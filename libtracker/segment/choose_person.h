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
  float score = 0;    // how much it looks like a person: large in the image, near, of a person's shape
  bool sure = false;  // no mere remnant of the actor
};

// Keeps the current actor, even when partly occluded. Switches only if another component scores far above the actor's
// usual score, which means that an object was being tracked. If no component, or only a small one, is known to be the
// actor: takes the component near the expected place that looks most like a person, never one that is known to be
// another person. `scores` receives the score of each component.
Choice choosePerson(const std::vector<Component>& components, const SegmentConfig& config, const ChoiceContext& context,
                    std::vector<float>& scores);

}  // namespace depthmocap

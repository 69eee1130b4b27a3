#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "libtracker/core/room_map.h"
#include "libtracker/segment/components.h"
#include "libtracker/segment/segment.h"

namespace depthmocap {

// True when the background may have been removed already: beside boards (1 in `is_board`, one per component) less than
// half of the image is measured, and every large component (15 % of the measured cells or more) fits into a person's
// box (2.4 m wide and high, 2 m deep). Raw stereo and yards do so, too.
bool mayBeCutOut(const CoarseCloud& cloud, const std::vector<Component>& components,
                 const std::vector<std::uint8_t>& is_board);
// Less than half of the image is measured, `but` cells aside.
bool isSparse(const CoarseCloud& cloud, int but = 0);
// Whether nearly all that is measured looks like people to the room classifier.
bool showsOnlyPeople(const RoomMap& map);

// What choosing needs to know about the frame.
struct ChoiceContext {
  bool cut_out = false;       // the background is already removed: everything is a person's but flat things
  double min_area_cells = 1;  // smaller components are no person
  const std::vector<float>* evidence = nullptr;  // of each component, mean logarithm of the odds; null where cut_out
};

// Who is looked for.
struct WantedPerson {
  Identity who = 1;
  const ExpectedActor* expected = nullptr;  // null = anybody
  float usual_score = 0;                    // in the frames before
  float usual_area_m2 = 0;
  // Others who are out of view: what lies nearer to where one of them is expected is left to that one.
  std::span<const ExpectedActor* const> missing = {};
};

// Which component is the actor.
struct Choice {
  std::int32_t person = kNoComponent;
  float score = 0;    // how much it looks like a person: large in the image, near, with evidence
  bool sure = false;  // no mere remnant of the actor
};

// How much each component looks like a person, at least 0.
void scoreComponents(const std::vector<Component>& components, const SegmentConfig& config,
                     const ChoiceContext& context, std::vector<float>& scores);

// Keeps a known person, even when partly occluded. Switches only if another component scores far above the person's
// usual score, which means that an object was being tracked. If no component, or only a small one, is known to be the
// person's: takes the component near the expected place that looks most like a person, never one that is known to be
// another person's. `owners` (one per component): what is somebody's already in this frame is not chosen.
Choice choosePerson(const std::vector<Component>& components, const std::vector<float>& scores,
                    const std::vector<Identity>& owners, const WantedPerson& wanted);

}  // namespace depthmocap

#pragma once
#include <cstdint>
#include <vector>

#include "libtracker/core/room_map.h"
#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/identity.h"

namespace depthmocap {

// How much speaks for a person at each cell of a coarse cloud: what the room classifier says, what the frame before
// knew, and what neighbours on the same surface say. A sofa that somebody sits on belongs to the same surface only
// as far as their borders are smooth: evidence fades with the distance along the surface and ends at steps.
class PersonEvidence {
 public:
  // `known`: one identity per cell, or empty. `gap_m`: neighbours farther apart are different surfaces. Reuses memory.
  void find(const CoarseCloud& cloud, const RoomMap& map, const std::vector<Identity>& known, double gap_m);

  // One per cell: logarithm of the odds that it shows a person; 0 where nothing is measured.
  [[nodiscard]] const std::vector<float>& odds() const { return odds_; }
  // One per cell: logarithm of the odds that it is floor, wall or ceiling, by the classifier.
  [[nodiscard]] const std::vector<float>& shell() const { return shell_; }

 private:
  void readMap(const CoarseCloud& cloud, const RoomMap& map);
  void measureSteps(const CoarseCloud& cloud, float gap_m);
  void smooth(const CoarseCloud& cloud);

  std::vector<float> odds_;
  std::vector<float> shell_;
  std::vector<float> right_;  // how much of its evidence a cell hands to its right neighbour, [0, 1)
  std::vector<float> down_;   // and to the one below
  std::vector<float> there_;  // working memory of smooth()
};

}  // namespace depthmocap

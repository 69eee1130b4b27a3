#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libtracker/segment/components.h"

namespace depthmocap {

// Joins to the chosen component the pieces that belong to the same body but were cut off by a gap in the depth: close
// pieces that are no person of their own, hands held out, limbs that come out from behind the body.
class FragmentJoiner {
 public:
  // `who` is the actor. `cut_out`: the background is already removed, so that what is left is mostly the actor.
  // `company`: somebody else is or was near just now, whose pieces could be taken for the actor's. `owners` (one per
  // component): pieces that are already somebody's are not joined. `selected` receives 1 per component that is part of
  // the actor.
  void join(const CoarseCloud& cloud, const ComponentFinder& found, std::int32_t person, Identity who, bool cut_out,
            bool company, const std::vector<Identity>& owners, std::vector<std::uint8_t>& selected);

 private:
  struct Search;  // one call's inputs
  void samplePoints(const CoarseCloud& cloud, const ComponentFinder& found);
  [[nodiscard]] float gapBetween(std::size_t a, std::size_t b) const;
  [[nodiscard]] bool belongs(const Search& search, std::size_t piece) const;

  std::vector<std::vector<Eigen::Vector3f>> samples_;  // some points of each component
  std::vector<std::size_t> seen_;
};

}  // namespace depthmocap

#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "libtracker/segment/coarse_cloud.h"

namespace depthmocap {

// Whose a piece of surface is, as far as the frames before say.
enum class Identity : std::uint8_t { Unknown, Actor, Other };

// Carries from frame to frame which surface is the actor's and which is not, so that people who touch are told apart,
// and nobody who was somebody else becomes the actor.
class IdentityMemory {
 public:
  // For each cell of a frame the identity of the nearest surface of the frame before; Unknown where nothing was near.
  // Reuses the memory of `known`.
  void recall(const CoarseCloud& cloud, std::vector<Identity>& known) const;
  // The present frame, for the next one: `identities` one per component, `labels` the component of each cell.
  void remember(const CoarseCloud& cloud, const std::vector<std::int32_t>& labels,
                const std::vector<Identity>& identities);
  void forget() { identities_.clear(); }

 private:
  [[nodiscard]] Identity nearest(const CoarseCloud& cloud, int x, int y) const;

  std::vector<Eigen::Vector3f> points_;  // of the frame before, as CoarseCloud has them
  std::vector<Identity> identities_;     // one per cell; empty = nothing is known
};

}  // namespace depthmocap

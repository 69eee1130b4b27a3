#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "libtracker/segment/coarse_cloud.h"

namespace depthmocap {

// Whose a piece of surface is, as far as the frames before say: a person's by number (1 ..), nobody's that is known, or
// somebody's who is not followed.
using Identity = std::uint8_t;
inline constexpr Identity kUnknown = 0;
inline constexpr Identity kSomebodyElse = 255;

// Carries from frame to frame which surface is whose, so that people who touch are told apart, and nobody who was
// somebody else becomes one of those who are followed.
class IdentityMemory {
 public:
  // For each cell of a frame the identity of the nearest surface of the frame before; kUnknown where nothing was near.
  // Reuses the memory of `known`.
  void recall(const CoarseCloud& cloud, std::vector<Identity>& known);
  // The present frame, for the next one: `identities` one per component, `labels` the component of each cell.
  void remember(const CoarseCloud& cloud, const std::vector<std::int32_t>& labels,
                const std::vector<Identity>& identities);
  void forget(Identity who) { std::replace(identities_.begin(), identities_.end(), who, kUnknown); }
  void forgetAll() { identities_.clear(); }

 private:
  struct DepthRange {
    float near_m;  // [m] above far_m: nothing
    float far_m;
    void include(const DepthRange& other) {
      near_m = std::min(near_m, other.near_m);
      far_m = std::max(far_m, other.far_m);
    }
  };

  struct CellBox {
    int x0, y0, x1, y1;  // [x0, x1) and [y0, y1)
  };

  [[nodiscard]] CellBox boxOfKnown(const CoarseCloud& cloud) const;
  void findDepthsAround(const CoarseCloud& cloud, const CellBox& box);
  [[nodiscard]] Identity nearest(const CoarseCloud& cloud, int x, int y) const;

  std::vector<Eigen::Vector3f> points_;  // of the frame before, as CoarseCloud has them
  std::vector<Identity> identities_;     // one per cell; empty = nothing is known
  std::vector<DepthRange> around_;       // of what is known within reach of each cell
  std::vector<DepthRange> in_row_;       // working memory of findDepthsAround()
};

}  // namespace depthmocap

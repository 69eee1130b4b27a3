#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/identity.h"

namespace depthmocap {

// One connected piece of surface. Heights are along the up direction that was given, [m].
struct Component {
  int cells = 0;
  float area_m2 = 0;                               // [m^2] facing the camera
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();  // camera frame [m]
  Eigen::Vector3f low = Eigen::Vector3f::Zero();   // bounding box in the camera frame [m]
  Eigen::Vector3f high = Eigen::Vector3f::Zero();
  float bottom_m = 0;
  float top_m = 0;
  float thickness_m = 0;  // standard deviation across its best plane
  bool touches_border = false;
  bool touches_side = false;  // the left or the right border
  Identity who = kUnknown;    // of a fair share of its cells

  [[nodiscard]] float height() const { return top_m - bottom_m; }
  [[nodiscard]] float widthX() const { return high.x() - low.x(); }
  [[nodiscard]] float depthZ() const { return high.z() - low.z(); }
};

inline constexpr std::int32_t kNoComponent = -1;

// Connected components of a coarse cloud. Keeps its memory from frame to frame.
class ComponentFinder {
 public:
  // Neighbouring cells (also across one missing cell) are connected when their points are at most gap_m apart; the gap
  // grows with the depth beyond 3 m as the sensors' depth steps do. Cells with keep[i] == 0 take no part. `up`: unit,
  // camera frame. `known` (one per cell, or empty): cells of different identities are never connected.
  void find(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep, double gap_m, const Eigen::Vector3f& up,
            std::span<const Identity> known = {});

  // The cells of a component for which moves(cell) is true become a component of their own, the last one. The other
  // arguments as they were given to find().
  template <typename Moves>
  void split(const CoarseCloud& cloud, const Eigen::Vector3f& up, std::span<const Identity> known, std::int32_t label,
             Moves&& moves) {
    const auto added = static_cast<std::int32_t>(components_.size());
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      if (labels_[i] == label && moves(i)) labels_[i] = added;
    }
    components_.assign(components_.size() + 1, {});
    describe(cloud, up, known);
  }

  [[nodiscard]] const std::vector<Component>& components() const { return components_; }
  [[nodiscard]] const std::vector<std::int32_t>& labels() const {
    return labels_;
  }  // a cell's component or kNoComponent

 private:
  std::int32_t root(std::int32_t cell);
  void connectCells(const CoarseCloud& cloud, const std::vector<std::uint8_t>& keep, float gap_m);
  void connect(std::int32_t a, std::int32_t b);
  void numberComponents();
  void describe(const CoarseCloud& cloud, const Eigen::Vector3f& up, std::span<const Identity> known);
  void measure(const CoarseCloud& cloud, const Eigen::Vector3f& up);
  void identify(std::span<const Identity> known);

  std::vector<std::int32_t> parent_;
  std::vector<Identity> who_;  // of the cells that a root stands for
  std::vector<std::int32_t> labels_;
  std::vector<Component> components_;
  std::vector<Eigen::Matrix3d> moments_;
  std::vector<int> known_cells_;
};

}  // namespace depthmocap

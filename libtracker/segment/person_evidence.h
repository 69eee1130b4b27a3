#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "libtracker/core/room_map.h"
#include "libtracker/segment/coarse_cloud.h"
#include "libtracker/segment/identity.h"

namespace depthmocap {

// How much speaks for a person at each cell of a coarse cloud: what the room classifier says, what the frame before
// knew, and what neighbours on the same surface say. A sofa that somebody sits on belongs to the same surface only
// as far as their borders are smooth: evidence fades with the distance along the surface and ends at steps. Feet and
// the floor are different surfaces.
class PersonEvidence {
 public:
  // `known`: one identity per cell, or empty. Reuses memory.
  void read(const CoarseCloud& cloud, const RoomMap& map, const std::vector<Identity>& known);
  // After `read`. `off_floor`: one per cell, 0 for the floor. `gap_m`: neighbours farther apart are different surfaces.
  void smooth(const CoarseCloud& cloud, const std::vector<std::uint8_t>& off_floor, double gap_m);

  // One per cell: logarithm of the odds that it shows a person; 0 where nothing is measured. Each for itself after
  // `read`, with its neighbours' after `smooth`.
  [[nodiscard]] const std::vector<float>& odds() const { return odds_; }
  // One per cell: logarithm of the odds that it is floor, wall or ceiling, by the classifier.
  [[nodiscard]] const std::vector<float>& shell() const { return shell_; }

 private:
  // Of the map, near a cell of the cloud along one axis.
  struct MapCell {
    int map = 0;     // column or row of the map
    int cell = 0;    // of the cloud, that it shows
    float away = 0;  // [cells of the map]
  };
  struct Around {
    int count = 0;
    std::array<MapCell, 2> near;
  };

  static void findAround(int cells, const CoarseCloud& cloud, const RoomMap& map, int map_cells,
                         std::vector<Around>& around);
  void readMap(const CoarseCloud& cloud, const RoomMap& map);
  static std::size_t cellFor(const CoarseCloud& cloud, const RoomMap& map, float z, const Around& column,
                             const Around& row);
  void measureSteps(const CoarseCloud& cloud, const std::vector<std::uint8_t>& off_floor, float gap_m);
  void smoothColumns(const Eigen::ArrayXXf& share, Eigen::ArrayXXf& values);

  std::vector<float> odds_;
  std::vector<float> shell_;
  // How much of its evidence a cell hands to its right neighbour, [0, 1), a column (y, x); and to the one below (x, y).
  Eigen::ArrayXXf right_;
  Eigen::ArrayXXf down_;
  // Working memory.
  std::vector<Around> columns_;
  std::vector<Around> rows_;
  Eigen::ArrayXXf image_;
  Eigen::ArrayXXf turned_;
  Eigen::ArrayXXf above_;  // what comes from the cells above, and its weight
  Eigen::ArrayXXf above_weight_;
  Eigen::ArrayXf below_;  // likewise, of one row
  Eigen::ArrayXf below_weight_;
  Eigen::ArrayXf here_;
};

}  // namespace depthmocap

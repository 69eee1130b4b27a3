#include "libtracker/segment/person_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "libtracker/segment/depth_noise.h"

namespace depthmocap {
namespace {

// Chosen on rendered rooms (docs/lab/rooms.md).

// Greatest logarithm of the odds that the classifier gives alone: one cell that errs is outvoted by its neighbours.
constexpr float kMostOdds = 3.0F;
// Logarithm of the odds that is added where the frame before had a person.
constexpr float kKnownOdds = 1.5F;
// Share of its evidence that a cell hands to its neighbour on the same surface: it fades to 1 / e over 5 cells. Written
// out: the exponential function of some machines differs in the last bit.
constexpr float kPassedOn = 0.8187308F;
// [1/m] What a step in depth costs beside the distance in the map, in cells of the map.
constexpr float kDepthCost_per_m = 20.0F;
// Rounds of smoothing: with one, evidence goes along rows and columns only.
constexpr int kRounds = 2;

float limited(float odds) {
  return std::clamp(odds, -kMostOdds, kMostOdds);
}

}  // namespace

void PersonEvidence::read(const CoarseCloud& cloud, const RoomMap& map, const std::vector<Identity>& known) {
  readMap(cloud, map);
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (known[i] != kUnknown && cloud.points[i].z() > 0) odds_[i] += kKnownOdds;
  }
}

// Along one axis of the cloud: the one or two cells of the map around each of its cells.
void PersonEvidence::findAround(int cells, const CoarseCloud& cloud, const RoomMap& map, int map_cells,
                                std::vector<Around>& around) {
  around.resize(static_cast<std::size_t>(cells));
  for (int c = 0; c < cells; ++c) {
    const float at = static_cast<float>(c * cloud.stride + cloud.offset - map.offset) / static_cast<float>(map.stride);
    Around& here = around[static_cast<std::size_t>(c)];
    here.count = at > std::floor(at) ? 2 : 1;  // on a column or row of the map there is one
    for (int k = 0; k < here.count; ++k) {
      const int m = std::clamp(static_cast<int>(at) + k, 0, map_cells - 1);
      const int cell = std::clamp((m * map.stride + map.offset - cloud.offset) / cloud.stride, 0, cells - 1);
      here.near[static_cast<std::size_t>(k)] = {m, cell, std::abs(static_cast<float>(m) - at)};
    }
  }
}

// The map is coarser than the cloud: a cell takes what the nearest of the up to four map cells around it says that lies
// at about its depth, so that outlines stay where the depth has them.
void PersonEvidence::readMap(const CoarseCloud& cloud, const RoomMap& map) {
  odds_.assign(cloud.points.size(), 0.0F);
  shell_.assign(cloud.points.size(), 0.0F);
  findAround(cloud.width, cloud, map, map.width, columns_);
  findAround(cloud.height, cloud, map, map.height, rows_);
  for (int y = 0; y < cloud.height; ++y) {
    const Around& row = rows_[static_cast<std::size_t>(y)];
    for (int x = 0; x < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      const float z = cloud.points[i].z();
      if (!(z > 0)) continue;
      const std::size_t m = cellFor(cloud, map, z, columns_[static_cast<std::size_t>(x)], row);
      if (map.measured[m] == 0) continue;
      odds_[i] = limited(map.person[m]);
      shell_[i] = map.shell[m];
    }
  }
}

// One that is measured, if there is one.
std::size_t PersonEvidence::cellFor(const CoarseCloud& cloud, const RoomMap& map, float z, const Around& column,
                                    const Around& row) {
  std::size_t chosen = map.index(column.near[0].map, row.near[0].map);
  if (column.count * row.count == 1) return chosen;
  const float per_m = kDepthCost_per_m / gapGrowth(z);
  float best = std::numeric_limits<float>::max();
  for (int j = 0; j < row.count; ++j) {
    const MapCell& v = row.near[static_cast<std::size_t>(j)];
    for (int k = 0; k < column.count; ++k) {
      const MapCell& u = column.near[static_cast<std::size_t>(k)];
      const std::size_t m = map.index(u.map, v.map);
      const float there = cloud.points[cloud.index(u.cell, v.cell)].z();
      const float cost = u.away + v.away + per_m * std::abs(there - z);
      const bool is_better = map.measured[m] != 0 && cost < best;
      best = is_better ? cost : best;
      chosen = is_better ? m : chosen;
    }
  }
  return chosen;
}

void PersonEvidence::measureSteps(const CoarseCloud& cloud, const std::vector<std::uint8_t>& off_floor, float gap_m) {
  right_.setZero(cloud.height, cloud.width);
  down_.setZero(cloud.width, cloud.height);
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const std::size_t i = cloud.index(x, y);
      const float z = cloud.points[i].z();
      if (!(z > 0)) continue;
      const float per_gap = 1.0F / (gap_m * gapGrowth(z));
      const auto share = [&](std::size_t j) {
        const float there = cloud.points[j].z();
        const float step = std::abs(z - there) * per_gap;
        return there > 0 && step < 1.0F && off_floor[i] == off_floor[j] ? kPassedOn * (1.0F - step * step) : 0.0F;
      };
      if (x + 1 < cloud.width) right_(y, x) = share(i + 1);
      if (y + 1 < cloud.height) down_(x, y) = share(i + static_cast<std::size_t>(cloud.width));
    }
  }
}

// Each row, then each column, becomes the mean of its cells weighted by the product of the shares on the way (a
// recursive edge-preserving filter: Gastal and Oliveira 2011). All columns go at once, and rows as columns of the
// turned image, so that vectors hold neighbours.
void PersonEvidence::smooth(const CoarseCloud& cloud, const std::vector<std::uint8_t>& off_floor, double gap_m) {
  measureSteps(cloud, off_floor, static_cast<float>(gap_m));
  Eigen::Map<Eigen::ArrayXXf> odds(odds_.data(), cloud.width, cloud.height);
  image_ = odds;
  for (int round = 0; round < kRounds; ++round) {
    turned_ = image_.transpose();
    smoothColumns(right_, turned_);
    image_ = turned_.transpose();
    smoothColumns(down_, image_);
  }
  odds = image_;
}

void PersonEvidence::smoothColumns(const Eigen::ArrayXXf& share, Eigen::ArrayXXf& values) {
  const Eigen::Index rows = values.cols();
  above_.resize(values.rows(), rows);
  above_weight_.resize(values.rows(), rows);
  above_.col(0).setZero();
  above_weight_.col(0).setZero();
  for (Eigen::Index y = 1; y < rows; ++y) {
    above_.col(y) = share.col(y - 1) * (above_.col(y - 1) + values.col(y - 1));
    above_weight_.col(y) = share.col(y - 1) * (above_weight_.col(y - 1) + 1.0F);
  }
  below_.setZero(values.rows());
  below_weight_.setZero(values.rows());
  for (Eigen::Index y = rows - 1; y >= 0; --y) {
    below_ *= share.col(y);
    below_weight_ *= share.col(y);
    here_ = values.col(y);
    values.col(y) = (above_.col(y) + here_ + below_) / (above_weight_.col(y) + 1.0F + below_weight_);
    below_ += here_;
    below_weight_ += 1.0F;
  }
}

}  // namespace depthmocap

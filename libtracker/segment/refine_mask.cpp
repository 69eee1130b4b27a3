#include "libtracker/segment/refine_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "libtracker/segment/depth_noise.h"
#include "libtracker/segment/find_floor.h"

namespace depthmocap {

namespace {

// [m] Largest step between neighbouring pixels of one surface. Chosen by hand (docs/tuning.md).
constexpr float kGrowStep_m = 0.02F;
constexpr std::int32_t kOpen = 2;  // mask value while working: no cell speaks for this pixel

struct CellBox {
  int x0, y0, x1, y1;  // inclusive
};

CellBox boxOfSelected(const CoarseCloud& cloud, const std::vector<std::int32_t>& labels,
                      const std::vector<std::uint8_t>& selected) {
  CellBox box{cloud.width, cloud.height, -1, -1};
  for (int y = 0; y < cloud.height; ++y) {
    for (int x = 0; x < cloud.width; ++x) {
      const std::int32_t label = labels[cloud.index(x, y)];
      if (label == kNoComponent || selected[static_cast<std::size_t>(label)] == 0) continue;
      box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x), std::max(box.y1, y)};
    }
  }
  return box;
}

constexpr int kLanes = 4;
using Floats = float __attribute__((vector_size(kLanes * sizeof(float))));
using Ints = std::int32_t __attribute__((vector_size(kLanes * sizeof(std::int32_t))));
using Bytes = std::uint8_t __attribute__((vector_size(kLanes)));

template <typename Vector, typename Value>
Vector load(const Value* from) {
  Vector vector;
  std::memcpy(&vector, from, sizeof vector);
  return vector;
}

Floats absolute(Floats value) {
  return value < 0 ? -value : value;
}

// Refines all pixels between two rows of cells, four at a time.
class RowRefiner {
 public:
  // Columns [first, end) of the picture.
  RowRefiner(const DepthImage& depth, const CameraModel& camera, const RefineLimits& limits, int first, int end)
      : depth_(depth), limits_(limits), first_(first), count_(end - first) {
    const int blocks = (count_ + kLanes - 1) / kLanes;
    const std::size_t room = static_cast<std::size_t>(blocks) * static_cast<std::size_t>(kLanes);
    row_.assign(room, 0.0F);
    for (auto& z : corner_z_) z.assign(room, kNoDepth_m);
    for (auto& actor : corner_is_actor_) actor.assign(room, 0);
    is_asked_.assign(room, 0);
    if (!limits.floor) return;
    const Eigen::Vector4d n = limits.floor->cast<double>();
    // n.p / z for the pixel (u, v) = slope.(u, v, 1)
    slope_ = Eigen::Vector3d(n.x() / camera.fx, n.y() / camera.fy,
                             n.z() - n.x() * camera.cx / camera.fx - n.y() * camera.cy / camera.fy)
                 .cast<float>();
    floor_offset_ = limits.floor->w();
  }

  // Before the rows between the cells of rows cy and cy + 1; cells outside of the cloud speak for nothing.
  void place(const CoarseCloud& cloud, const std::vector<std::int32_t>& labels,
             const std::vector<std::uint8_t>& selected, int cy, int first_cx, int end_cx) {
    for (int cx = first_cx; cx < end_cx; ++cx) {
      std::array<float, kCorners> z{};
      std::array<std::int32_t, kCorners> is_actor{};
      int measured = 0;
      int actors = 0;
      for (std::size_t k = 0; k < kCorners; ++k) {
        const int x = cx + static_cast<int>(k & 1U);
        const int y = cy + static_cast<int>(k >> 1U);
        z[k] = kNoDepth_m;
        if (x < 0 || y < 0 || x >= cloud.width || y >= cloud.height) continue;
        const std::size_t i = cloud.index(x, y);
        if (!(cloud.points[i].z() > 0)) continue;
        z[k] = cloud.points[i].z();
        is_actor[k] = labels[i] != kNoComponent && selected[static_cast<std::size_t>(labels[i])] != 0 ? 1 : 0;
        ++measured;
        actors += is_actor[k];
      }
      const int from = std::max(0, cx * cloud.stride + cloud.offset - first_);
      const int to = std::min(count_, (cx + 1) * cloud.stride + cloud.offset - first_);
      for (int x = from; x < to; ++x) {
        const auto at = static_cast<std::size_t>(x);
        for (std::size_t k = 0; k < kCorners; ++k) {
          corner_z_[k][at] = z[k];
          corner_is_actor_[k][at] = is_actor[k];
        }
        is_asked_[at] = measured == 0 || actors > 0 ? -1 : 0;
      }
    }
  }

  // Adds to `open` what no cell speaks for.
  void refine(int y, MaskImage& mask, std::vector<std::size_t>& open) {
    std::copy_n(&depth_.at(first_, y), count_, row_.begin());
    std::uint8_t* to = &mask.at(first_, y);
    for (int x = 0; x < count_; x += kLanes) {
      const Ints answer = decide(x, y);
      const Bytes bytes = __builtin_convertvector(answer, Bytes);
      const int lanes = std::min(kLanes, count_ - x);
      if (lanes == kLanes) {
        std::memcpy(to + x, &bytes, sizeof bytes);
      } else {
        for (int k = 0; k < lanes; ++k) to[x + k] = bytes[k];
      }
      const Ints is_open = answer == kOpen;
      if ((is_open[0] | is_open[1] | is_open[2] | is_open[3]) == 0) continue;
      for (int k = 0; k < lanes; ++k) {
        if (is_open[k] != 0) open.push_back(mask.index(first_ + x + k, y));
      }
    }
  }

 private:
  static constexpr std::size_t kCorners = 4;
  static constexpr float kNoDepth_m = 1e9F;  // far from everything

  [[nodiscard]] Ints decide(int x, int y) const {
    const auto at = static_cast<std::size_t>(x);
    const Floats z = load<Floats>(&row_[at]);
    const Floats beyond = z / kGapGrowsFrom_m;
    Floats nearest = static_cast<float>(limits_.gap_m) * (beyond > 1.0F ? beyond : Floats{} + 1.0F);
    Ints answer = Ints{} + std::int32_t{kOpen};
    for (std::size_t k = 0; k < kCorners; ++k) {
      const Floats distance = absolute(load<Floats>(&corner_z_[k][at]) - z);
      const Ints is_nearer = distance <= nearest;
      nearest = is_nearer ? distance : nearest;
      answer = is_nearer ? load<Ints>(&corner_is_actor_[k][at]) : answer;
    }
    const Ints is_near_enough = z <= static_cast<float>(limits_.max_depth_m);
    const Ints is_measured = z > 0;
    const Ints in_range = is_measured & is_near_enough & (z >= static_cast<float>(limits_.min_depth_m));
    return answer & in_range & load<Ints>(&is_asked_[at]) & ~onFloor(x, y, z);
  }

  [[nodiscard]] Ints onFloor(int x, int y, Floats z) const {
    if (!limits_.floor) return Ints{};
    const Floats column = static_cast<float>(first_ + x) + Floats{0, 1, 2, 3};
    const Floats along = slope_.x() * column + (slope_.y() * static_cast<float>(y) + slope_.z());
    const float flat = floorTolerance(limits_.floor_distance_m, *limits_.floor, 0.0F);
    const float per_m = floorTolerance(limits_.floor_distance_m, *limits_.floor, 1.0F) - flat;
    return z * along + floor_offset_ < flat + per_m * z;
  }

  const DepthImage& depth_;
  const RefineLimits& limits_;
  int first_;
  int count_;
  Eigen::Vector3f slope_ = Eigen::Vector3f::Zero();
  float floor_offset_ = 0;
  std::vector<float> row_;  // [m] depth of the row, with room for whole vectors
  // For each column: of the four cells around its pixels the depth, and whether it is the actor's; and -1 where none of
  // the four is measured or one is the actor's, 0 where all pixels are somebody else's.
  std::array<std::vector<float>, kCorners> corner_z_;
  std::array<std::vector<std::int32_t>, kCorners> corner_is_actor_;
  std::vector<std::int32_t> is_asked_;
};

// Once in the order of the image and once against it; open pixels that nothing reaches become background.
void growIntoOpen(const DepthImage& depth, const PixelBox& box, const std::vector<std::size_t>& open, MaskImage& mask) {
  const auto joins = [&](std::size_t i, std::size_t j) {
    return mask.data[j] == 1 && std::abs(depth.data[i] - depth.data[j]) <= kGrowStep_m;
  };
  const auto width = static_cast<std::size_t>(mask.width);
  for (const std::size_t i : open) {
    const auto x = static_cast<int>(i % width);
    const auto y = static_cast<int>(i / width);
    if ((x > box.x0 && joins(i, i - 1)) || (y > box.y0 && joins(i, i - width))) mask.data[i] = 1;
  }
  for (auto at = open.rbegin(); at != open.rend(); ++at) {
    const std::size_t i = *at;
    if (mask.data[i] != kOpen) continue;
    const auto x = static_cast<int>(i % width);
    const auto y = static_cast<int>(i / width);
    const bool reached = (x + 1 < box.x1 && joins(i, i + 1)) || (y + 1 < box.y1 && joins(i, i + width));
    mask.data[i] = reached ? 1 : 0;
  }
}

}  // namespace

PixelBox refineMask(const DepthImage& depth, const CameraModel& camera, const CoarseCloud& cloud,
                    const std::vector<std::int32_t>& labels, const std::vector<std::uint8_t>& selected,
                    const RefineLimits& limits, MaskImage& mask) {
  mask.reset(depth.width, depth.height, 0);
  const CellBox box = boxOfSelected(cloud, labels, selected);
  if (box.x1 < 0) return {};
  const auto pixel = [&](int cell, int limit) { return std::clamp(cell * cloud.stride + cloud.offset, 0, limit); };
  const PixelBox pixels{pixel(box.x0 - 2, depth.width), pixel(box.y0 - 2, depth.height), pixel(box.x1 + 2, depth.width),
                        pixel(box.y1 + 2, depth.height)};
  RowRefiner refiner(depth, camera, limits, pixels.x0, pixels.x1);
  std::vector<std::size_t> open;
  for (int cy = box.y0 - 2; cy <= box.y1 + 1; ++cy) {
    refiner.place(cloud, labels, selected, cy, box.x0 - 2, box.x1 + 2);
    for (int y = pixel(cy, depth.height); y < pixel(cy + 1, depth.height); ++y) refiner.refine(y, mask, open);
  }
  growIntoOpen(depth, pixels, open, mask);
  return pixels;
}

}  // namespace depthmocap

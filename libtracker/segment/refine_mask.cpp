#include "libtracker/segment/refine_mask.h"

#include <algorithm>
#include <cmath>

#include "libtracker/segment/depth_noise.h"
#include "libtracker/segment/find_floor.h"

namespace depthmocap {

namespace {

// [m] Largest step between neighbouring pixels of one surface. Chosen by hand (docs/tuning.md).
constexpr float kGrowStep_m = 0.02F;
constexpr std::uint8_t kOpen = 2;  // mask value while working: no cell speaks for this pixel

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

// Refines the pixels between four neighbouring cells at a time.
class BlockRefiner {
 public:
  BlockRefiner(const DepthImage& depth, const CameraModel& camera, const CoarseCloud& cloud,
               const std::vector<std::int32_t>& labels, const std::vector<std::uint8_t>& selected,
               const RefineLimits& limits, MaskImage& mask)
      : depth_(depth), cloud_(cloud), labels_(labels), selected_(selected), limits_(limits), mask_(mask) {
    if (!limits.floor) return;
    const Eigen::Vector4d n = limits.floor->cast<double>();
    // n.p / z for the pixel (u, v) = slope.(u, v, 1)
    slope_ = Eigen::Vector3d(n.x() / camera.fx, n.y() / camera.fy,
                             n.z() - n.x() * camera.cx / camera.fx - n.y() * camera.cy / camera.fy)
                 .cast<float>();
    floor_offset_ = limits.floor->w();
  }

  // The block between cells (cx, cy) and (cx + 1, cy + 1); cells outside the cloud speak for nothing.
  void refine(int cx, int cy) {
    int corner_count = 0;
    bool any_selected = false;
    for (int k = 0; k < 4; ++k) {
      const int x = cx + (k & 1);
      const int y = cy + (k >> 1);
      if (x < 0 || y < 0 || x >= cloud_.width || y >= cloud_.height) continue;
      const std::size_t i = cloud_.index(x, y);
      const float z = cloud_.points[i].z();
      if (!(z > 0)) continue;
      const bool is_actor = labels_[i] != kNoComponent && selected_[static_cast<std::size_t>(labels_[i])] != 0;
      corners_[corner_count++] = {z, is_actor};
      any_selected |= is_actor;
    }
    if (corner_count > 0 && !any_selected) return;
    const int x0 = std::max(0, cx * cloud_.stride + cloud_.offset);
    const int y0 = std::max(0, cy * cloud_.stride + cloud_.offset);
    const int x1 = std::min(depth_.width, (cx + 1) * cloud_.stride + cloud_.offset);
    const int y1 = std::min(depth_.height, (cy + 1) * cloud_.stride + cloud_.offset);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) mask_.at(x, y) = decide(x, y, corner_count);
    }
  }

 private:
  struct Corner {
    float z;
    bool is_actor;
  };

  [[nodiscard]] std::uint8_t decide(int x, int y, int corner_count) const {
    const float z = depth_.at(x, y);
    if (!(z > 0 && z >= static_cast<float>(limits_.min_depth_m) && z <= static_cast<float>(limits_.max_depth_m)))
      return 0;
    if (limits_.floor && onFloor(x, y, z)) return 0;
    float nearest = static_cast<float>(limits_.gap_m) * gapGrowth(z);
    std::uint8_t answer = kOpen;
    for (int k = 0; k < corner_count; ++k) {
      const float distance = std::abs(corners_[k].z - z);
      if (distance > nearest) continue;
      nearest = distance;
      answer = corners_[k].is_actor ? 1 : 0;
    }
    return answer;
  }
  [[nodiscard]] bool onFloor(int x, int y, float z) const {
    const float along = slope_.x() * static_cast<float>(x) + slope_.y() * static_cast<float>(y) + slope_.z();
    return z * along + floor_offset_ < floorTolerance(limits_.floor_distance_m, *limits_.floor, z);
  }

  const DepthImage& depth_;
  const CoarseCloud& cloud_;
  const std::vector<std::int32_t>& labels_;
  const std::vector<std::uint8_t>& selected_;
  const RefineLimits& limits_;
  MaskImage& mask_;
  Eigen::Vector3f slope_ = Eigen::Vector3f::Zero();
  float floor_offset_ = 0;
  Corner corners_[4] = {};
};

// One sweep each way; open pixels that nothing reaches become background.
void growIntoOpen(const DepthImage& depth, int x0, int y0, int x1, int y1, MaskImage& mask) {
  const auto joins = [&](std::size_t i, std::size_t j) {
    return mask.data[j] == 1 && std::abs(depth.data[i] - depth.data[j]) <= kGrowStep_m;
  };
  const auto width = static_cast<std::size_t>(mask.width);
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const std::size_t i = mask.index(x, y);
      if (mask.data[i] == kOpen && ((x > x0 && joins(i, i - 1)) || (y > y0 && joins(i, i - width)))) mask.data[i] = 1;
    }
  }
  for (int y = y1 - 1; y >= y0; --y) {
    for (int x = x1 - 1; x >= x0; --x) {
      const std::size_t i = mask.index(x, y);
      if (mask.data[i] != kOpen) continue;
      const bool reached = (x + 1 < x1 && joins(i, i + 1)) || (y + 1 < y1 && joins(i, i + width));
      mask.data[i] = reached ? 1 : 0;
    }
  }
}

}  // namespace

void refineMask(const DepthImage& depth, const CameraModel& camera, const CoarseCloud& cloud,
                const std::vector<std::int32_t>& labels, const std::vector<std::uint8_t>& selected,
                const RefineLimits& limits, MaskImage& mask) {
  mask.reset(depth.width, depth.height, 0);
  const CellBox box = boxOfSelected(cloud, labels, selected);
  if (box.x1 < 0) return;
  BlockRefiner refiner(depth, camera, cloud, labels, selected, limits, mask);
  for (int cy = box.y0 - 2; cy <= box.y1 + 1; ++cy) {
    for (int cx = box.x0 - 2; cx <= box.x1 + 1; ++cx) refiner.refine(cx, cy);
  }
  const auto pixel = [&](int cell, int limit) { return std::clamp(cell * cloud.stride + cloud.offset, 0, limit); };
  growIntoOpen(depth, pixel(box.x0 - 2, depth.width), pixel(box.y0 - 2, depth.height), pixel(box.x1 + 2, depth.width),
               pixel(box.y1 + 2, depth.height), mask);
}

}  // namespace depthmocap

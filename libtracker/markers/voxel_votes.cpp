#include "libtracker/markers/voxel_votes.h"

#include <algorithm>
#include <cmath>

namespace depthmocap {

void PartVotes::clear() {
  x.clear();
  y.clear();
  z.clear();
  weight.clear();
  area.clear();
}

namespace {

constexpr std::size_t kMinSlots = 1024;

// 21 bits an axis: 2 million cubes, tens of kilometres at the sizes used here.
std::uint64_t cellBits(float coordinate_cells) {
  constexpr std::int64_t kHalf = 1 << 20;
  return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(coordinate_cells)) + kHalf) & 0x1FFFFFU;
}

std::size_t slotsFor(std::size_t pixel_count) {
  std::size_t slots = kMinSlots;
  while (slots < 2 * pixel_count) slots *= 2;
  return slots;
}

}  // namespace

VoxelVotes::Voxel& VoxelVotes::voxelAt(const Eigen::Vector3f& p_camera, float inverse_voxel) {
  const Eigen::Vector3f cell = p_camera * inverse_voxel;
  const std::uint64_t key = cellBits(cell.x()) << 42U | cellBits(cell.y()) << 21U | cellBits(cell.z());
  const std::size_t last = slots_.size() - 1;
  for (std::size_t i = (key * 0x9E3779B97F4A7C15ULL >> 32U) & last;; i = (i + 1) & last) {
    Slot& slot = slots_[i];
    if (slot.generation != generation_) {
      slot = {key, generation_, static_cast<std::uint32_t>(voxels_.size())};
      return voxels_.emplace_back();
    }
    if (slot.key == key) return voxels_[slot.voxel];
  }
}

void VoxelVotes::build(const ClassifiedPixels& pixels, const CameraModel& camera, double min_probability,
                       double voxel_m) {
  voxels_.clear();
  if (slots_.size() < slotsFor(pixels.pixels.size())) slots_.assign(slotsFor(pixels.pixels.size()), Slot{});
  if (++generation_ == 0) {  // wrapped around: old slots would look new
    std::fill(slots_.begin(), slots_.end(), Slot{});
    generation_ = 1;
  }
  const auto inverse_voxel = static_cast<float>(1.0 / voxel_m);
  const auto threshold = static_cast<float>(min_probability);
  const double area_factor = pixels.stride * pixels.stride / (camera.fx * camera.fy);
  for (const ClassifiedPixels::Pixel& pixel : pixels.pixels) {
    const double depth = static_cast<double>(pixel.depth_m);
    if (!(depth > 0)) continue;
    const Eigen::Vector3f p_camera = camera.unproject(pixel.x, pixel.y, depth).cast<float>();
    const auto area = static_cast<float>(area_factor * depth * depth);
    Voxel& voxel = voxelAt(p_camera, inverse_voxel);
    voxel.sum += p_camera;
    voxel.pixels += 1.0F;
    for (std::size_t part = 0; part < kPartCount; ++part) {
      const float probability = pixel.probability[part];
      const float vote = probability >= threshold ? area : 0.0F;
      voxel.weight[part] += vote * probability;
      voxel.area[part] += vote;
    }
  }
}

void VoxelVotes::gather(int part, PartVotes& votes) const {
  votes.clear();
  const auto p = static_cast<std::size_t>(part);
  for (const Voxel& voxel : voxels_) {
    if (!(voxel.weight[p] > 0)) continue;
    const Eigen::Vector3f mean = voxel.sum / voxel.pixels;
    votes.x.push_back(mean.x());
    votes.y.push_back(mean.y());
    votes.z.push_back(mean.z());
    votes.weight.push_back(voxel.weight[p]);
    votes.area.push_back(voxel.area[p]);
  }
}

}  // namespace depthmocap
